// A frame at a moment, stage by stage.
#pragma once

#include "render/frame.h"

namespace swell::render {

// Draws a request whose arguments are checked. The workspace has the sea of that time already, or
// makes its own (FrameState::sea).
FrameStatistics draw_moment(const World& world, const FrameRequest& request, double t_s,
                            Workspace& workspace, Workers& workers);

}  // namespace swell::render
