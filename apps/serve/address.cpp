#include "apps/serve/address.h"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <unistd.h>

#include <array>
#include <memory>
#include <random>
#include <stdexcept>

namespace swell::serve {
namespace {

// 128 bits of the system's.
std::string new_token() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

bool is_any(const std::string& host) { return host == "0.0.0.0" || host == "::"; }

std::string text_of(const sockaddr& address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  const void* bytes =
      address.sa_family == AF_INET
          ? static_cast<const void*>(&reinterpret_cast<const sockaddr_in&>(address).sin_addr)
          : &reinterpret_cast<const sockaddr_in6&>(address).sin6_addr;
  return inet_ntop(address.sa_family, bytes, text.data(), text.size()) ? text.data() : "";
}

// By which other machines reach this one: IPv4 first, and no address that holds on one link alone.
std::vector<std::string> own_addresses() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> owned(first, &freeifaddrs);
  std::vector<std::string> found;
  for (const int family : {AF_INET, AF_INET6})
    for (const ifaddrs* one = first; one; one = one->ifa_next) {
      if (!one->ifa_addr || one->ifa_addr->sa_family != family) continue;
      if ((one->ifa_flags & IFF_LOOPBACK) || !(one->ifa_flags & IFF_UP)) continue;
      const std::string text = text_of(*one->ifa_addr);
      if (!text.empty() && !text.starts_with("fe80:")) found.push_back(text);
    }
  return found;
}

std::string own_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace

Address parse_address(const std::string& text) {
  Address address;
  const std::size_t colon = text.rfind(':');
  if (colon != std::string::npos) {
    address.host = text.substr(0, colon);
    if (address.host.size() > 2 && address.host.front() == '[' && address.host.back() == ']')
      address.host = address.host.substr(1, address.host.size() - 2);
    else if (address.host.find(':') != std::string::npos)
      address.host.clear();
  }
  const std::string port = colon == std::string::npos ? text : text.substr(colon + 1);
  const bool digits = !port.empty() && port.size() <= 5 &&
                      port.find_first_not_of("0123456789") == std::string::npos;
  address.port = digits ? std::stoi(port) : -1;
  if (address.host.empty() || address.port < 0 || address.port > 65535)
    throw std::invalid_argument("got '" + text + "', allowed [ADDRESS:]PORT, PORT 0 to 65535");
  address.token = new_token();
  return address;
}

bool is_loopback(const std::string& host) {
  return host == "127.0.0.1" || host == "localhost" || host == "::1";
}

AccessRules rules_of(const Address& address, int port) {
  std::vector<std::string> hosts = {"localhost", "127.0.0.1", "::1"};
  if (is_any(address.host)) {
    for (std::string& own : own_addresses()) hosts.push_back(std::move(own));
    if (std::string name = own_name(); !name.empty()) hosts.push_back(std::move(name));
  } else {
    hosts.push_back(address.host);
  }
  return {std::move(hosts), address.proxies, address.token, port};
}

std::vector<std::string> urls_of(const Address& address, int port) {
  std::vector<std::string> hosts = {address.host};
  if (is_any(address.host)) {
    const std::vector<std::string> own = own_addresses();
    const std::string name = own_name();
    hosts.clear();
    if (!own.empty())
      hosts.push_back(own.front());
    else if (!name.empty())
      hosts.push_back(name);
    hosts.push_back(address.host == "::" ? "::1" : "127.0.0.1");
  }
  std::vector<std::string> urls;
  for (const std::string& host : hosts) {
    urls.push_back(fmt::format("http://{}:{}/", bracketed(host), port));
    if (!address.token.empty()) urls.back() += "?token=" + address.token;
  }
  return urls;
}

std::string bracketed(const std::string& host) {
  return host.find(':') == std::string::npos ? host : "[" + host + "]";
}

}  // namespace swell::serve
