#include "apps/dataset/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "apps/shared/label_picture.h"
#include "texture/image/image_io.h"

namespace swell::apps {
namespace {

constexpr int kMostShown = 64, kMostColumns = 8;
constexpr int kCellWidth_px = 192, kGap_px = 4;

}  // namespace

ContactSheet::ContactSheet(int samples, int width_px, int height_px)
    : samples_(samples),
      shown_(std::min(samples, kMostShown)),
      columns_(std::min(static_cast<int>(std::ceil(std::sqrt(shown_))), kMostColumns)),
      cell_width_px_(std::min(width_px, kCellWidth_px)),
      cell_height_px_(std::max(1, height_px * cell_width_px_ / width_px)) {
  const int rows = (shown_ + columns_ - 1) / columns_;
  sheet_ = {columns_ * (cell_width_px_ + kGap_px) + kGap_px,
            rows * (cell_height_px_ + kGap_px) + kGap_px,
            3,
            {}};
  sheet_.pixels.assign(static_cast<std::size_t>(sheet_.width) * sheet_.height * 3, 255);
}

int ContactSheet::place_of(int sample) const {
  // Place p shows sample p * samples / shown.
  const auto place = (std::int64_t{sample} * shown_ + samples_ - 1) / samples_;
  return place < shown_ && place * samples_ / shown_ == sample ? static_cast<int>(place) : -1;
}

bool ContactSheet::shows(int sample) const { return place_of(sample) >= 0; }

void ContactSheet::add(int sample, const std::filesystem::path& picture,
                       std::span<const SheetBox> boxes) {
  const texture::ImageF image = texture::read_image(picture);
  const int place = place_of(sample);
  const int left = kGap_px + place % columns_ * (cell_width_px_ + kGap_px);
  const int top = kGap_px + place / columns_ * (cell_height_px_ + kGap_px);
  const auto put = [&](int x, int y, int c, std::uint8_t value) {
    sheet_.pixels[(static_cast<std::size_t>(top + y) * sheet_.width + left + x) * 3 +
                  static_cast<std::size_t>(c)] = value;
  };
  // A pixel of the sheet is the mean of those that it covers.
  for (int y = 0; y < cell_height_px_; ++y)
    for (int x = 0; x < cell_width_px_; ++x) {
      const int x0 = x * image.width / cell_width_px_, y0 = y * image.height / cell_height_px_;
      const int x1 = std::max((x + 1) * image.width / cell_width_px_, x0 + 1);
      const int y1 = std::max((y + 1) * image.height / cell_height_px_, y0 + 1);
      for (int c = 0; c < 3; ++c) {
        float sum = 0.0f;
        for (int v = y0; v < y1; ++v)
          for (int u = x0; u < x1; ++u) sum += image.at(u, v, c);
        const float mean = sum / static_cast<float>((x1 - x0) * (y1 - y0));
        put(x, y, c, static_cast<std::uint8_t>(std::lround(255.0f * mean)));
      }
    }
  for (const SheetBox& box : boxes) {
    const std::uint32_t colour = number_colour(static_cast<std::uint32_t>(box.category) + 1);
    const auto column = [&](int x) { return x * cell_width_px_ / image.width; };
    const auto row = [&](int y) { return y * cell_height_px_ / image.height; };
    const int x0 = column(box.x_px), x1 = column(box.x_px + box.width_px - 1);
    const int y0 = row(box.y_px), y1 = row(box.y_px + box.height_px - 1);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x)
        if (x == x0 || x == x1 || y == y0 || y == y1)
          for (int c = 0; c < 3; ++c) put(x, y, c, static_cast<std::uint8_t>(colour >> (8 * c)));
  }
}

std::vector<std::uint8_t> ContactSheet::encode() const {
  return texture::encode_image(sheet_, ".png");
}

}  // namespace swell::apps
