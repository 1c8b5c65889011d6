// Which pictures this version draws.
#pragma once

namespace swell::render {

// Another number wherever a bit of a picture, a label or an answer of a shipped scene may be
// another: programs of one number draw the same. Who changes such a bit raises it, and renews
// tests/sameness_version.txt as its test says.
inline constexpr int kSamenessVersion = 8;

}  // namespace swell::render
