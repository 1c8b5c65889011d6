#include "apps/serve/picture_server.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <mutex>
#include <thread>

#include "apps/serve/connection.h"

namespace swell::serve {

using boost::asio::ip::tcp;
using Error = boost::system::error_code;

struct PictureServer::Machinery {
  Machinery(const Address& where, Hooks given)
      : address(where),
        hooks(std::move(given)),
        pictures(kMostSeats, hooks.on_change, [this] { tell_of_picture(); }) {}

  void listen();
  void accept();
  void take(tcp::socket socket);
  void make_room();
  void tell_of_picture();
  void run();
  template <class Tell>
  void for_each_connection(Tell tell);

  // In this order: connections, which handlers of `io` own, need all that stands before it.
  const Address address;
  const Hooks hooks;
  PictureStream pictures;
  Lobby lobby;
  std::mutex camera_mutex;
  std::string camera;
  std::atomic<bool> is_scene_wanted = false;  // since the last was written
  std::atomic<bool> is_panel_open = false;
  std::vector<std::weak_ptr<Connection>> connections;  // the oldest first
  boost::asio::io_context io{1};
  tcp::acceptor acceptor{io};
  boost::asio::steady_timer pause{io};
  std::thread thread;
};

namespace {

constexpr int kSendBuffer_bytes = 262144;  // a slow browser is seconds behind with more

}  // namespace

void PictureServer::Machinery::listen() try {
  const tcp::endpoint endpoint =
      tcp::resolver(io)
          .resolve(address.host, std::to_string(address.port), tcp::resolver::passive)
          .begin()
          ->endpoint();
  acceptor.open(endpoint.protocol());
  // Without SO_REUSEPORT, by which two servers would share a port.
  acceptor.set_option(tcp::acceptor::reuse_address(true));
  acceptor.bind(endpoint);
  acceptor.listen();
} catch (const boost::system::system_error& error) {
  throw ServerError(fmt::format("cannot listen on {}:{}: {}", bracketed(address.host), address.port,
                                error.code().message()));
}

void PictureServer::Machinery::accept() {
  acceptor.async_accept([this](Error error, tcp::socket socket) {
    if (!error) {
      take(std::move(socket));
      return accept();
    }
    if (error == boost::asio::error::operation_aborted) return;
    pause.expires_after(std::chrono::milliseconds(100));  // no file descriptor is free
    pause.async_wait([this](Error) { accept(); });
  });
}

void PictureServer::Machinery::take(tcp::socket socket) {
  make_room();
  if (connections.size() >= kMostConnections) return;
  Error ignored;
  socket.set_option(tcp::no_delay(true), ignored);
  socket.set_option(tcp::socket::send_buffer_size(kSendBuffer_bytes), ignored);
  const auto connection = std::make_shared<Connection>(std::move(socket), lobby);
  connections.push_back(connection);
  connection->start();
}

void PictureServer::Machinery::make_room() {
  std::erase_if(connections, [](const auto& one) {
    const auto connection = one.lock();
    return !connection || connection->is_closed();
  });
  if (connections.size() < kMostConnections) return;
  const auto oldest =
      std::ranges::find_if(connections, [](const auto& one) { return !one.lock()->is_trusted(); });
  if (oldest == connections.end()) return;
  oldest->lock()->close();
  connections.erase(oldest);
}

template <class Tell>
void PictureServer::Machinery::for_each_connection(Tell tell) {
  for (const auto& one : connections)
    if (const auto connection = one.lock()) tell(*connection);
}

void PictureServer::Machinery::tell_of_picture() {
  boost::asio::post(io, [this] { for_each_connection([](Connection& c) { c.picture_came(); }); });
}

// A fault in a handler, such as no memory, ends that handler's connection alone.
void PictureServer::Machinery::run() {
  for (;;) try {
      io.run();
      return;
    } catch (const std::exception&) {
    }
}

PictureServer::PictureServer(const Address& address, Hooks hooks)
    : machinery_(std::make_unique<Machinery>(address, std::move(hooks))) {
  Machinery& all = *machinery_;
  all.listen();
  all.lobby.site = {rules_of(address, port()), all.hooks.take, [&all] {
                      const std::scoped_lock lock(all.camera_mutex);
                      return all.camera;
                    }};
  all.lobby.pictures = &all.pictures;
  all.lobby.want_scene = [&all] { all.is_scene_wanted = true; };
  all.lobby.is_panel_open = [&all] { return all.is_panel_open.load(); };
  all.accept();
  all.thread = std::thread([&all] { all.run(); });
}

PictureServer::~PictureServer() {
  machinery_->io.stop();
  machinery_->thread.join();
}

int PictureServer::port() const { return machinery_->acceptor.local_endpoint().port(); }

std::vector<std::string> PictureServer::urls() const {
  return urls_of(machinery_->address, port());
}

PictureStream& PictureServer::stream() { return machinery_->pictures; }

void PictureServer::set_camera(std::string toml) {
  const std::scoped_lock lock(machinery_->camera_mutex);
  machinery_->camera = std::move(toml);
}

void PictureServer::set_panel_open(bool is_open) { machinery_->is_panel_open = is_open; }

void PictureServer::answer_scene(const std::function<std::string()>& write) {
  if (!machinery_->is_scene_wanted.exchange(false)) return;
  boost::asio::post(machinery_->io, [all = machinery_.get(), toml = write()] {
    all->for_each_connection([&](Connection& c) { c.scene_came(toml); });
  });
}

}  // namespace swell::serve
