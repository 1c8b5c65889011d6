// The viewer in a browser.
#pragma once

#include "apps/serve/picture_server.h"
#include "apps/view/viewer.h"

namespace swell::serve {

inline constexpr int kMostFiles = 100;  // that browsers can make the program write

// Draws with SDL's dummy driver, panel included, while somebody looks, and prints the URLs and the
// folder of the files that are saved from the panel. Ends with SIGINT, SIGTERM or SIGHUP, but not
// with one that was ignored when the program started. Throws ServerError, and what Viewer throws.
void serve(const scene::Scene& scene, view::ViewerSettings settings, const Address& address);

}  // namespace swell::serve
