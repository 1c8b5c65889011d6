// Who may ask the server for what: a function of the request's head alone.
//
// Three kinds of strangers are kept out. A page of another site names another Origin. A page whose
// own name was pointed to this machine (DNS rebinding) names a Host that is not this server's:
// Origin is compared with Host only after Host was found in a list that no request can change. All
// others, such as other users of the machine, lack the token.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/serve/http_request.h"

namespace swell::serve {

struct AccessRules {
  std::vector<std::string> hosts;    // names and addresses of this server, of IPv6 without brackets
  std::vector<std::string> proxies;  // names given with --serve-host, of proxies before it
  std::string token;                 // empty: none needed
  int port = 0;                      // in the cookie's name: cookies do not know ports
};

struct Verdict {
  int status = 200;  // 200: go on
  std::string line;  // why not
};

// The token is taken from "Authorization: Bearer TOKEN", from the page's cookie, and for the page
// itself ("/") from the query. A Host with any port is taken: an ssh tunnel has a port of its own,
// and what a page can set is never the port alone.
Verdict judge(const Request& request, const AccessRules& rules);

std::string cookie_name(int port);

}  // namespace swell::serve
