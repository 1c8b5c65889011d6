// What this process may take.
#pragma once

namespace swell::mesh_import {

// Bounds its address space and its time, and keeps it from writing files. Call it first.
void limit_process();

}  // namespace swell::mesh_import
