// The newest picture, for many who may be slow: each gets the newest one when it asks, and what
// came in between is dropped. Who draws never waits for who looks.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace swell::serve {

class PictureStream {
 public:
  // A place among those who look, for as long as it lives.
  class Seat {
   public:
    explicit Seat(PictureStream& stream) : stream_(stream) {}
    ~Seat() { stream_.leave(); }
    Seat(const Seat&) = delete;
    Seat& operator=(const Seat&) = delete;

   private:
    PictureStream& stream_;
  };

  // `on_change` is called when somebody comes or goes, from any thread; `on_picture` when a picture
  // was published.
  explicit PictureStream(int most_seats, std::function<void()> on_change = {},
                         std::function<void()> on_picture = {})
      : most_seats_(most_seats),
        on_change_(std::move(on_change)),
        on_picture_(std::move(on_picture)) {}

  // None if all places are taken.
  std::shared_ptr<Seat> take_seat();
  bool is_watched() const;
  int most_seats() const { return most_seats_; }

  // Calls fill(rgba), which sets 4 x width_px x height_px bytes, and makes that the newest picture.
  void publish(int width_px, int height_px,
               const std::function<void(std::vector<std::uint8_t>&)>& fill);

  struct Jpeg {
    std::uint64_t number = 0;  // of the picture, counted from 1; 0: none
    std::shared_ptr<const std::string> bytes;
  };
  // The newest picture if it came after that of this number. Each is compressed once, by the first
  // who asks.
  Jpeg newest(std::uint64_t after);

 private:
  struct Picture {
    std::uint64_t number = 0;
    int width_px = 0, height_px = 0;
    std::vector<std::uint8_t> rgba;
    std::mutex compressing;
    std::shared_ptr<const std::string> jpeg;
  };

  void leave();
  std::shared_ptr<Picture> unused_picture();

  const int most_seats_;
  const std::function<void()> on_change_, on_picture_;
  mutable std::mutex mutex_;
  int seats_ = 0;
  std::uint64_t count_ = 0;
  std::shared_ptr<Picture> newest_;
  std::vector<std::shared_ptr<Picture>> pool_;
};

}  // namespace swell::serve
