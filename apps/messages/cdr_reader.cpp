#include "apps/messages/cdr_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>

namespace swell::apps {
namespace {

static_assert(std::endian::native == std::endian::little, "bytes are turned where they are big");

// Goes on with zeros and empty text once something is wrong.
class CdrReader {
 public:
  explicit CdrReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    is_right_ = bytes.size() >= kHead && bytes[0] == 0 && bytes[1] <= 1;
    is_big_endian_ = is_right_ && bytes[1] == 0;
  }

  template <class Number>
  void read(Number& number) {
    const std::size_t off = (at_ - kHead) % sizeof number;
    if (off != 0) at_ += sizeof number - off;
    std::array<std::uint8_t, sizeof number> its{};
    if (take(sizeof number)) {
      std::ranges::copy(bytes_.subspan(at_ - sizeof number, sizeof number), its.begin());
      if (is_big_endian_) std::ranges::reverse(its);
    }
    std::memcpy(&number, its.data(), sizeof number);
  }

  void read(std::string& text) {
    std::uint32_t size = 0;
    read(size);
    if (!take(size)) return;
    if (size == 0 || bytes_[at_ - 1] != 0) {
      is_right_ = false;
      return;
    }
    text.assign(reinterpret_cast<const char*>(bytes_.data()) + at_ - size, size - 1);
  }

  // Writers may fill up to a multiple of four bytes.
  bool is_whole() const { return is_right_ && bytes_.size() - at_ < 4; }

 private:
  static constexpr std::size_t kHead = 4;

  bool take(std::size_t count) {
    is_right_ = is_right_ && at_ <= bytes_.size() && count <= bytes_.size() - at_;
    if (is_right_) at_ += count;
    return is_right_;
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = kHead;
  bool is_right_ = false, is_big_endian_ = false;
};

void read_time(CdrReader& reader, msg::Time& time) {
  reader.read(time.sec);
  reader.read(time.nanosec);
}

}  // namespace

std::optional<msg::Clock> read_clock(std::span<const std::uint8_t> bytes) {
  CdrReader reader(bytes);
  msg::Clock message;
  read_time(reader, message.clock);
  if (!reader.is_whole()) return std::nullopt;
  return message;
}

std::optional<msg::PoseStamped> read_pose_stamped(std::span<const std::uint8_t> bytes) {
  CdrReader reader(bytes);
  msg::PoseStamped message;
  read_time(reader, message.header.stamp);
  reader.read(message.header.frame_id);
  msg::Pose& pose = message.pose;
  for (double* number : {&pose.position.x, &pose.position.y, &pose.position.z, &pose.orientation.x,
                         &pose.orientation.y, &pose.orientation.z, &pose.orientation.w})
    reader.read(*number);
  if (!reader.is_whole()) return std::nullopt;
  return message;
}

}  // namespace swell::apps
