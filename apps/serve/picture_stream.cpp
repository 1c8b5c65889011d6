#include "apps/serve/picture_stream.h"

#include "apps/jpeg/jpeg.h"

namespace swell::serve {
namespace {

constexpr apps::JpegSettings kJpeg = {.quality = 85, .is_fast = true};

std::string jpeg_of(const std::vector<std::uint8_t>& rgba, int width_px, int height_px) {
  const std::vector<std::uint8_t> bytes = apps::jpeg_bytes(rgba, width_px, height_px, kJpeg);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::shared_ptr<PictureStream::Seat> PictureStream::take_seat() {
  {
    const std::scoped_lock lock(mutex_);
    if (seats_ == most_seats_) return nullptr;
    if (seats_++ == 0) newest_.reset();  // of the last who looked
  }
  if (on_change_) on_change_();
  return std::make_shared<Seat>(*this);
}

void PictureStream::leave() {
  {
    const std::scoped_lock lock(mutex_);
    --seats_;
  }
  if (on_change_) on_change_();
}

bool PictureStream::is_watched() const {
  const std::scoped_lock lock(mutex_);
  return seats_ > 0;
}

// One that nobody else holds, for its storage; made if there is none. Under the lock.
std::shared_ptr<PictureStream::Picture> PictureStream::unused_picture() {
  for (const std::shared_ptr<Picture>& picture : pool_)
    if (picture.use_count() == 1) return picture;
  pool_.push_back(std::make_shared<Picture>());
  return pool_.back();
}

void PictureStream::publish(int width_px, int height_px,
                            const std::function<void(std::vector<std::uint8_t>&)>& fill) {
  std::shared_ptr<Picture> picture;
  {
    const std::scoped_lock lock(mutex_);
    picture = unused_picture();
  }
  picture->jpeg.reset();
  picture->width_px = width_px;
  picture->height_px = height_px;
  picture->rgba.resize(4u * static_cast<std::size_t>(width_px) *
                       static_cast<std::size_t>(height_px));
  fill(picture->rgba);
  {
    const std::scoped_lock lock(mutex_);
    picture->number = ++count_;
    newest_ = std::move(picture);
  }
  if (on_picture_) on_picture_();
}

PictureStream::Jpeg PictureStream::newest(std::uint64_t after) {
  std::shared_ptr<Picture> picture;
  std::uint64_t number = 0;
  {
    const std::scoped_lock lock(mutex_);
    if (!newest_ || newest_->number <= after) return {};
    picture = newest_;
    number = picture->number;
  }
  const std::scoped_lock lock(picture->compressing);
  if (!picture->jpeg)
    picture->jpeg = std::make_shared<const std::string>(
        jpeg_of(picture->rgba, picture->width_px, picture->height_px));
  return {number, picture->jpeg};
}

}  // namespace swell::serve
