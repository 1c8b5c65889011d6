#include "apps/serve/picture_server.h"

#include <fmt/core.h>
#include <httplib.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <random>

#include "apps/serve/browser_events.h"
#include "apps/serve/page.h"
#include "apps/shared/parse_number.h"

namespace swell::serve {
namespace {

constexpr const char* kText = "text/plain; charset=utf-8";
constexpr const char* kBoundary = "picture";
constexpr int kSendBuffer_bytes = 262144;  // a slow browser is seconds behind with more
constexpr int kWriteTimeout_s = 10;        // who takes nothing for so long is left
constexpr std::chrono::seconds kLongestSceneWait{5};
constexpr int kOtherThreads = 12;  // for events and pages

bool is_this_machine(const std::string& host) {
  return host == "127.0.0.1" || host == "localhost" || host == "::1";
}

// 128 bits of the system's.
std::string new_token() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

void refuse(httplib::Response& response, int status, const std::string& line) {
  response.status = status;
  response.set_content(line + "\n", kText);
}

std::string bracketed(const std::string& host) {
  return host.find(':') == std::string::npos ? host : "[" + host + "]";
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
  if (!is_this_machine(address.host)) address.token = new_token();
  return address;
}

PictureServer::PictureServer(const Address& address, Hooks hooks)
    : address_(address),
      hooks_(std::move(hooks)),
      stream_(kMostSeats, hooks_.on_change),
      http_(std::make_unique<httplib::Server>()) {
  http_->new_task_queue = [] { return new httplib::ThreadPool(kMostSeats + kOtherThreads); };
  http_->set_payload_max_length(kMostBytes);
  http_->set_write_timeout(kWriteTimeout_s, 0);
  http_->set_keep_alive_max_count(100000);
  http_->set_tcp_nodelay(true);
  // Without SO_REUSEPORT, by which two servers would share a port.
  http_->set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &kSendBuffer_bytes, sizeof kSendBuffer_bytes);
  });
  add_pages();
  errno = 0;
  port_ = address.port > 0 ? (http_->bind_to_port(address.host, address.port) ? address.port : -1)
                           : http_->bind_to_any_port(address.host);
  if (port_ <= 0)
    throw ServerError(fmt::format("cannot listen on {}:{}: {}", bracketed(address.host),
                                  address.port, errno ? std::strerror(errno) : "no such address"));
  thread_ = std::thread([this] { http_->listen_after_bind(); });
}

PictureServer::~PictureServer() {
  while (!http_->is_running()) std::this_thread::yield();  // stop() before would not be heard
  http_->stop();
  thread_.join();
}

std::string PictureServer::url() const {
  const std::string url = fmt::format("http://{}:{}/", bracketed(address_.host), port_);
  return address_.token.empty() ? url : url + "?token=" + address_.token;
}

void PictureServer::set_camera(std::string toml) {
  const std::scoped_lock lock(mutex_);
  camera_ = std::move(toml);
}

void PictureServer::answer_scene(const std::function<std::string()>& write) {
  {
    const std::scoped_lock lock(mutex_);
    if (!scene_wanted_) return;
    scene_wanted_ = false;
    scene_ = write();
    ++scenes_;
  }
  scene_came_.notify_all();
}

void PictureServer::send_scene(httplib::Response& response) {
  const auto seat = stream_.take_seat();  // so that a frame is drawn, after which it is written
  if (!seat) return refuse(response, 503, "too many look already");
  std::unique_lock lock(mutex_);
  const std::uint64_t before = scenes_;
  scene_wanted_ = true;
  const bool came = scene_came_.wait_for(lock, kLongestSceneWait, [&] { return scenes_ > before; });
  if (!came) return refuse(response, 503, "no picture yet");
  response.set_header("Content-Disposition", "attachment; filename=\"swell.toml\"");
  response.set_content(scene_, kText);
}

Verdict PictureServer::judge_request(const httplib::Request& request) const {
  Request head{request.method, request.target, {}, {}};
  for (const auto& field : request.headers) head.fields.push_back(field);
  std::vector<std::string> hosts = {"localhost", "127.0.0.1", "::1", address_.host};
  return judge(head, {std::move(hosts), address_.hosts, address_.token, port_});
}

void PictureServer::add_pages() {
  using httplib::Request;
  using httplib::Response;
  http_->set_pre_routing_handler([this](const Request& request, Response& response) {
    const Verdict verdict = judge_request(request);
    if (verdict.status == 200) return httplib::Server::HandlerResponse::Unhandled;
    refuse(response, verdict.status, verdict.line);
    return httplib::Server::HandlerResponse::Handled;
  });
  http_->set_error_handler([](const Request&, Response& response) {
    if (response.body.empty())
      response.set_content(fmt::format("status {}\n", response.status), kText);
  });
  http_->Get("/", [](const Request&, Response& response) {
    response.set_content(std::string(page_html()), "text/html; charset=utf-8");
  });
  http_->Get("/stream", [this](const Request&, Response& response) { answer_stream(response); });
  http_->Get("/stream/state", [](const Request&, Response& response) {
    response.set_content(fmt::format("no more than {} may look at once", kMostSeats), kText);
  });
  http_->Get("/picture.jpg", [this](const Request&, Response& response) {
    const auto seat = stream_.take_seat();  // so that one is drawn
    if (!seat) return refuse(response, 503, "too many look already");
    const PictureStream::Jpeg jpeg = stream_.next(0);
    if (jpeg.number == 0) return refuse(response, 503, "no picture yet");
    response.set_content(*jpeg.bytes, "image/jpeg");
  });
  http_->Get("/camera", [this](const Request&, Response& response) {
    const std::scoped_lock lock(mutex_);
    response.set_content(camera_, kText);
  });
  http_->Get("/scene", [this](const Request&, Response& response) { send_scene(response); });
  http_->Post("/input", [this](const Request& request, Response& response) {
    try {
      for (const SDL_Event& event : parse_events(request.body)) hooks_.take(event);
      response.status = 204;
    } catch (const EventError& error) {
      refuse(response, 400, error.what());
    }
  });
}

void PictureServer::answer_stream(httplib::Response& response) {
  auto seat = stream_.take_seat();
  if (!seat)
    return refuse(response, 503, fmt::format("no more than {} may look at once", kMostSeats));
  response.set_header("Cache-Control", "no-store");
  auto last = std::make_shared<std::uint64_t>(0);
  response.set_content_provider(
      fmt::format("multipart/x-mixed-replace; boundary={}", kBoundary),
      [this, seat = std::move(seat), last](std::size_t, httplib::DataSink& sink) {
        const PictureStream::Jpeg jpeg = stream_.next(*last);
        if (jpeg.number == 0) return sink.is_writable();
        *last = jpeg.number;
        const std::string head =
            fmt::format("--{}\r\nContent-Type: image/jpeg\r\nContent-Length: {}\r\n\r\n", kBoundary,
                        jpeg.bytes->size());
        return sink.write(head.data(), head.size()) &&
               sink.write(jpeg.bytes->data(), jpeg.bytes->size()) && sink.write("\r\n", 2);
      });
}

}  // namespace swell::serve
