#include "apps/serve/connection.h"

#include <fmt/core.h>

#include <sstream>

namespace swell::serve {
namespace {

namespace beast = boost::beast;
namespace http = boost::beast::http;

using Clock = boost::asio::steady_timer::clock_type;
using std::chrono::seconds;
constexpr seconds kHeadDeadline{5};     // of a whole head, and of a whole body
constexpr seconds kIdleDeadline{60};    // between two requests
constexpr seconds kAnswerDeadline{10};  // of a whole answer but a stream
constexpr seconds kPieceDeadline{5};    // of a stream: until the client takes more
constexpr std::size_t kMostLingered_bytes = 1 << 20;
constexpr seconds kLingerDeadline{2};  // so that a refusal is read before the connection breaks
constexpr seconds kLongestWait{5};     // for a picture or the scene
constexpr seconds kHeartbeat{1};       // of a stream in which nothing changes

// Nobody is there to read an answer.
bool is_of_the_wire(const boost::system::error_code& error) {
  return error == beast::error::timeout || error == http::error::end_of_stream ||
         error == http::error::partial_message ||
         (error && error.category() == boost::system::system_category());
}

}  // namespace

Connection::Connection(boost::asio::ip::tcp::socket socket, const Lobby& lobby)
    : stream_(std::move(socket)),
      lobby_(lobby),
      buffer_(kMostBytes),
      timer_(stream_.get_executor()) {}

void Connection::start() { read_head(); }

void Connection::close() {
  if (is_closed_) return;
  is_closed_ = true;
  wait_ = Wait::kNothing;
  seat_.reset();
  timer_.cancel();
  stream_.close();
}

// ---- requests ----

// Waits for the first byte of the next one.
void Connection::read_next() {
  if (buffer_.size() > 0) return read_head();
  stream_.expires_after(kIdleDeadline);
  stream_.async_read_some(buffer_.prepare(4096),
                          [self = shared_from_this()](Error error, std::size_t count) {
                            if (error) return self->close();
                            self->buffer_.commit(count);
                            self->read_head();
                          });
}

void Connection::read_head() {
  parser_.emplace();
  stream_.expires_after(kHeadDeadline);
  http::async_read_header(
      stream_, buffer_, *parser_, [self = shared_from_this()](Error error, std::size_t) {
        if (self->is_closed_) return;
        if (is_of_the_wire(error)) return self->close();
        if (error) {
          const int status = status_of(error, self->parser_->is_header_done());
          return self->send(refusal(status, fmt::format("a bad request, or more than {} bytes of "
                                                        "head or body",
                                                        kMostBytes)),
                            true);
        }
        const Verdict verdict = judge(self->parser_->head(), self->lobby_.site.rules);
        if (verdict.status != 200) return self->send(refusal(verdict.status, verdict.line), true);
        self->is_trusted_ = true;
        self->read_body();
      });
}

void Connection::read_body() {
  stream_.expires_after(kHeadDeadline);
  http::async_read(
      stream_, buffer_, *parser_, [self = shared_from_this()](Error error, std::size_t) {
        if (self->is_closed_) return;
        if (error) {
          const int status = status_of(error, true);
          if (status != 413) return self->close();
          return self->send(refusal(413, fmt::format("a body of more than {} bytes", kMostBytes)),
                            true);
        }
        Request request = self->parser_->head();
        request.body = std::move(self->parser_->get().body());
        self->answer(request);
      });
}

// ---- answers ----

void Connection::answer(const Request& request) {
  Reply reply;
  try {
    reply = reply_to(request, lobby_.site);
  } catch (const std::exception&) {
    reply = refusal(500, "the viewer cannot answer");
  }
  switch (reply.what) {
    case Reply::What::kWhole:
      return send(reply, !parser_->keep_alive());
    case Reply::What::kStream:
      return answer_later(Wait::kStream);
    case Reply::What::kPicture:
      return answer_later(Wait::kPicture);
    case Reply::What::kScene:
      return answer_later(Wait::kScene);
  }
}

// Who waits has a seat, so that frames are drawn.
void Connection::answer_later(Wait wait) {
  seat_ = lobby_.pictures->take_seat();
  if (!seat_)
    return send(refusal(503, fmt::format("no more than {} may look at once",
                                         lobby_.pictures->most_seats())),
                !parser_->keep_alive());
  wait_ = wait;
  if (wait == Wait::kStream) return start_stream();
  if (wait == Wait::kScene) lobby_.want_scene();
  timer_.expires_after(kLongestWait);
  timer_.async_wait([self = shared_from_this()](Error error) {
    const bool is_of_an_earlier_wait = self->timer_.expiry() > Clock::now();
    if (error || self->wait_ == Wait::kNothing || is_of_an_earlier_wait) return;
    self->send(refusal(503, "no picture yet"), !self->parser_->keep_alive());
  });
  if (wait == Wait::kPicture) picture_came();
}

void Connection::scene_came(const std::string& toml) {
  if (wait_ != Wait::kScene) return;
  Reply reply{.body = toml};
  reply.fields = {{"Content-Disposition", "attachment; filename=\"swell.toml\""}};
  send(reply, !parser_->keep_alive());
}

void Connection::picture_came() {
  if (wait_ == Wait::kStream && !is_sending_) return stream_newest();
  if (wait_ != Wait::kPicture) return;
  const PictureStream::Jpeg jpeg = lobby_.pictures->newest(0);
  if (jpeg.number == 0) return;
  send({.type = "image/jpeg", .body = *jpeg.bytes}, !parser_->keep_alive());
}

void Connection::send(const Reply& reply, bool ends) {
  wait_ = Wait::kNothing;
  timer_.cancel();
  seat_.reset();  // before it is sent: who reads nothing keeps no seat
  response_ = {static_cast<http::status>(reply.status), 11};
  for (const auto& [name, value] : common_fields()) response_.set(name, value);
  for (const auto& [name, value] : reply.fields) response_.set(name, value);
  if (reply.status != 204) response_.set(http::field::content_type, reply.type);
  response_.keep_alive(!ends);
  response_.body() = reply.body;
  if (reply.status != 204) response_.prepare_payload();
  stream_.expires_after(kAnswerDeadline);
  http::async_write(
      stream_, response_, [self = shared_from_this(), ends](Error error, std::size_t) {
        if (self->is_closed_) return;
        if (error) return self->close();
        self->response_.body() = {};
        if (!ends) return self->read_next();
        Error ignored;
        self->stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
        self->stream_.expires_after(kLingerDeadline);
        self->linger();
      });
}

// A connection closed with unread bytes is reset, and the client may never see the answer.
void Connection::linger() {
  stream_.async_read_some(boost::asio::buffer(ignored_),
                          [self = shared_from_this()](Error error, std::size_t count) {
                            self->lingered_bytes_ += count;
                            if (error || self->lingered_bytes_ > kMostLingered_bytes)
                              return self->close();
                            self->linger();
                          });
}

// ---- the stream ----

constexpr const char* kBoundary = "picture";

void Connection::start_stream() {
  http::response<http::empty_body> head{http::status::ok, 11};
  for (const auto& [name, value] : common_fields()) head.set(name, value);
  head.set(http::field::content_type,
           fmt::format("multipart/x-mixed-replace; boundary={}", kBoundary));
  head.keep_alive(false);
  std::ostringstream text;
  text << head.base();
  stream_.expires_never();
  watch_for_end();
  stream_bytes(text.str());
}

// Whoever looks sends nothing more, but for the end.
void Connection::watch_for_end() {
  stream_.async_read_some(boost::asio::buffer(ignored_),
                          [self = shared_from_this()](Error error, std::size_t) {
                            if (error) return self->close();
                            self->watch_for_end();
                          });
}

void Connection::stream_newest() {
  PictureStream::Jpeg jpeg = lobby_.pictures->newest(shown_);
  if (jpeg.number == 0) return await_heartbeat();
  shown_ = jpeg.number;
  stream_bytes(fmt::format(
      "--{}\r\nContent-Type: image/jpeg\r\nX-Swell-Panel: {}\r\n"
      "Content-Length: {}\r\n\r\n{}\r\n",
      kBoundary, lobby_.is_panel_open() ? "open" : "closed", jpeg.bytes->size(), *jpeg.bytes));
}

// Where nothing changes, the last picture comes again: the page sees that the server lives. Before
// the first, it is an empty line, which readers of a multipart text pass over.
void Connection::await_heartbeat() {
  timer_.expires_after(kHeartbeat);
  timer_.async_wait([self = shared_from_this()](Error error) {
    if (error || self->is_closed_ || self->is_sending_) return;
    if (self->shown_ == 0) return self->stream_bytes("\r\n");
    self->shown_ = 0;
    self->stream_newest();
  });
}

void Connection::stream_bytes(std::string bytes) {
  timer_.cancel();
  sending_ = std::move(bytes);
  sent_ = 0;
  is_sending_ = true;
  stream_piece();
}

void Connection::stream_piece() {
  stream_.expires_after(kPieceDeadline);
  stream_.async_write_some(boost::asio::buffer(sending_.data() + sent_, sending_.size() - sent_),
                           [self = shared_from_this()](Error error, std::size_t count) {
                             if (error) return self->close();
                             self->sent_ += count;
                             if (self->sent_ < self->sending_.size()) return self->stream_piece();
                             self->is_sending_ = false;
                             self->stream_newest();
                           });
}

}  // namespace swell::serve
