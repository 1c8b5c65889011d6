// The viewer in a browser.
#pragma once

#include "apps/serve/picture_server.h"
#include "apps/view/viewer.h"

namespace swell::serve {

// Draws with SDL's dummy driver, panel included, while somebody looks, and prints the URL. Ends
// with SIGINT or SIGTERM. Throws ServerError, and what Viewer throws.
void serve(const scene::Scene& scene, view::ViewerSettings settings, const Address& address);

}  // namespace swell::serve
