#include "apps/serve/access_rules.h"

#include <fmt/core.h>

#include <algorithm>

namespace swell::serve {
namespace {

// Takes as long for a wrong token as for a right one of its length.
bool equals_secret(std::string_view given, std::string_view secret) {
  unsigned differs = given.size() != secret.size();
  for (std::size_t i = 0; i < std::min(given.size(), secret.size()); ++i)
    differs |= static_cast<unsigned char>(given[i] ^ secret[i]);
  return differs == 0;
}

bool is_port(std::string_view text) {
  return text.size() <= 5 && text.find_first_not_of("0123456789") == std::string_view::npos;
}

// "NAME", "NAME:80", "[::1]:80" -> the name or address; empty if it is none of these.
std::string_view host_of(std::string_view authority) {
  const bool is_ipv6 = authority.starts_with('[');
  const std::size_t end = is_ipv6 ? authority.find(']') : authority.find(':');
  const std::string_view host = authority.substr(is_ipv6, end - is_ipv6);
  if (end == std::string_view::npos) return is_ipv6 ? std::string_view() : authority;
  std::string_view rest = authority.substr(end + is_ipv6);
  if (rest.empty()) return host;
  return rest.front() == ':' && is_port(rest.substr(1)) ? host : std::string_view();
}

bool holds(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::any_of(names,
                             [&](const auto& one) { return equals_ignoring_case(one, name); });
}

// Short, in one line of ASCII, for the text of a refusal.
std::string shown(std::string_view text) {
  constexpr std::size_t kMost = 80;
  std::string line(text.substr(0, kMost));
  for (char& c : line)
    if (c < 0x20 || c > 0x7e) c = '?';
  return line + (text.size() > kMost ? "..." : "");
}

// Also of a proxy that gives the server a Host of its own choice: then the Origin has the name that
// --serve-host gave.
bool is_own_origin(std::string_view origin, std::string_view host, const AccessRules& rules) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (!origin.starts_with(scheme)) continue;
    const std::string_view authority = origin.substr(scheme.size());
    return equals_ignoring_case(authority, host) || holds(rules.proxies, host_of(authority));
  }
  return false;
}

// Whether a browser says that a page of another site asks. A link elsewhere may lead to the page:
// it is shown in a tab of its own, and the other site sees nothing of it.
bool is_from_elsewhere(const Request& request) {
  const auto is = [&](std::string_view field, std::string_view wanted) {
    return std::ranges::all_of(request.values(field), [&](auto value) { return value == wanted; });
  };
  if (request.values("Sec-Fetch-Site").empty() || is("Sec-Fetch-Site", "same-origin") ||
      is("Sec-Fetch-Site", "none"))
    return false;
  return request.method != "GET" || request.path() != "/" || !is("Sec-Fetch-Mode", "navigate") ||
         !is("Sec-Fetch-Dest", "document");
}

bool has_token_in_cookie(const Request& request, const AccessRules& rules) {
  const std::string name = cookie_name(rules.port) + "=";
  for (std::string_view rest : request.values("Cookie"))
    while (!rest.empty()) {
      std::string_view one = rest.substr(0, rest.find(';'));
      rest.remove_prefix(std::min(one.size() + 1, rest.size()));
      one.remove_prefix(std::min(one.find_first_not_of(' '), one.size()));
      if (one.starts_with(name) && equals_secret(one.substr(name.size()), rules.token)) return true;
    }
  return false;
}

bool has_token(const Request& request, const AccessRules& rules) {
  if (rules.token.empty() || has_token_in_cookie(request, rules)) return true;
  constexpr std::string_view kBearer = "Bearer ";
  for (const std::string_view value : request.values("Authorization"))
    if (equals_ignoring_case(value.substr(0, kBearer.size()), kBearer) &&
        equals_secret(value.substr(kBearer.size()), rules.token))
      return true;
  return request.path() == "/" && equals_secret(request.query_value("token"), rules.token);
}

}  // namespace

std::string cookie_name(int port) { return fmt::format("swell_token_{}", port); }

Verdict judge(const Request& request, const AccessRules& rules) {
  const auto hosts = request.values("Host");
  if (hosts.size() != 1) return {400, fmt::format("{} Host fields, allowed 1", hosts.size())};
  const std::string_view host = host_of(hosts.front());
  if (!holds(rules.hosts, host) && !holds(rules.proxies, host))
    return {421, fmt::format("Host '{}' is not this server's: another name is allowed with "
                             "--serve-host NAME",
                             shown(hosts.front()))};
  for (const std::string_view origin : request.values("Origin"))
    if (!is_own_origin(origin, hosts.front(), rules))
      return {403, fmt::format("Origin '{}' is another site's, allowed this server's own pages",
                               shown(origin))};
  if (is_from_elsewhere(request))
    return {403, "a page of another site asks, allowed this server's own pages"};
  if (!has_token(request, rules))
    return {403, "no token or a wrong one: open the URL that swell-view printed when it started"};
  return {};
}

}  // namespace swell::serve
