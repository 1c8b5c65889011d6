#include "apps/serve/routes.h"

#include <fmt/core.h>

#include <array>
#include <random>
#include <string_view>

#include "apps/serve/browser_events.h"
#include "apps/serve/page.h"

namespace swell::serve {
namespace {

Reply page(const Request&, const Site& site) {
  std::random_device random;
  const std::string nonce = fmt::format("{:08x}{:08x}{:08x}", random(), random(), random());
  Reply reply;
  reply.type = "text/html; charset=utf-8";
  reply.body = page_html(nonce);
  reply.fields = {{"Content-Security-Policy",
                   fmt::format("default-src 'none'; script-src 'nonce-{0}'; style-src 'nonce-{0}'; "
                               "connect-src 'self'; img-src data:; base-uri 'none'; "
                               "form-action 'none'; frame-ancestors 'none'",
                               nonce)}};
  // Without Path: a proxy's prefix, under which the page is asked for, is the cookie's then.
  if (!site.rules.token.empty())
    reply.fields.emplace_back(
        "Set-Cookie", fmt::format("{}={}; HttpOnly; SameSite=Strict", cookie_name(site.rules.port),
                                  site.rules.token));
  return reply;
}

Reply camera(const Request&, const Site& site) { return {.body = site.camera()}; }

Reply input(const Request& request, const Site& site) {
  try {
    for (const SDL_Event& event : parse_events(request.body)) site.take(event);
    return {.status = 204};
  } catch (const EventError& error) {
    return refusal(400, error.what());
  }
}

Reply stream(const Request&, const Site&) { return {.what = Reply::What::kStream}; }
Reply picture(const Request&, const Site&) { return {.what = Reply::What::kPicture}; }
Reply scene(const Request&, const Site&) { return {.what = Reply::What::kScene}; }

struct Route {
  std::string_view method, path;
  Reply (*reply)(const Request&, const Site&);
};
constexpr std::array kRoutes = {
    Route{"GET", "/", page},
    Route{"GET", "/stream", stream},
    Route{"GET", "/picture.jpg", picture},
    Route{"GET", "/camera", camera},
    Route{"GET", "/scene", scene},
    Route{"POST", "/input", input},
};

}  // namespace

Reply refusal(int status, const std::string& line) {
  return {.status = status, .body = line + "\n"};
}

std::vector<std::pair<std::string, std::string>> common_fields() {
  return {{"Cache-Control", "no-store"},
          {"X-Content-Type-Options", "nosniff"},
          {"Referrer-Policy", "no-referrer"},
          {"Cross-Origin-Resource-Policy", "same-origin"},
          {"Content-Security-Policy", "default-src 'none'; frame-ancestors 'none'"}};
}

Reply reply_to(const Request& request, const Site& site) {
  const Route* other = nullptr;
  for (const Route& route : kRoutes) {
    if (route.path != request.path()) continue;
    if (route.method == request.method) return route.reply(request, site);
    other = &route;
  }
  if (!other) return refusal(404, "no such page");
  Reply reply = refusal(405, fmt::format("allowed here: {}", other->method));
  reply.fields = {{"Allow", std::string(other->method)}};
  return reply;
}

}  // namespace swell::serve
