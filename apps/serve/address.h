// Where the server listens, what it is called, and the URLs that it prints.
#pragma once

#include <string>
#include <vector>

#include "apps/serve/access_rules.h"

namespace swell::serve {

struct Address {
  std::string host = "127.0.0.1";         // a name or an address, of IPv6 without brackets
  int port = 0;                           // 0: any that is free
  std::string token = {};                 // a secret of the URL; empty: none is needed
  std::vector<std::string> proxies = {};  // what --serve-host gave
};

// "[ADDRESS:]PORT", an IPv6 address in brackets; with a new token. Throws std::invalid_argument.
Address parse_address(const std::string& text);

// Whether only this machine reaches it, as far as its text says.
bool is_loopback(const std::string& host);

// The rules of a server that listens there on this port. At 0.0.0.0 and :: the machine's own
// addresses and its name count as the given address.
AccessRules rules_of(const Address& address, int port);

// For a browser; of 0.0.0.0 and ::, one for other machines and one for this one.
std::vector<std::string> urls_of(const Address& address, int port);

// "::1" -> "[::1]"; others as they are.
std::string bracketed(const std::string& host);

}  // namespace swell::serve
