#include "ocean/open_sea/patch_transforms.h"

#include <array>

#include "math/check.h"
#include "ocean/spectrum/fft.h"
#include "ocean/spectrum/patch_waves.h"

namespace swell::ocean {

void transform_patches(const Sea::State& state, double t_s, const PatchFills& fills,
                       std::span<const PatchFields> fields, std::vector<float>& planes,
                       Workers& workers) {
  const std::size_t patches = state.patches.size();
  SWELL_CHECK(fields.size() == patches && patches <= kMaxPatches, "{} patches, {} fields", patches,
              fields.size());
  std::array<FftOutput, 2 * kMaxPatches + (kMaxPatches + 1) / 2> outputs;
  std::size_t transforms = 0;
  for (const PatchFields& patch : fields) outputs[transforms++] = {patch.first, patch.second};
  for (std::size_t p = 0; p < patches; p += 2)
    outputs[transforms++] = {fields[p].third, p + 1 < patches ? fields[p + 1].third : nullptr};
  const std::size_t first_displaced = transforms;
  std::array<std::size_t, kMaxPatches> displaced;
  for (std::size_t p = 0; p < patches; ++p) {
    if (fields[p].displacement_x == nullptr) continue;
    displaced[transforms - first_displaced] = p;
    outputs[transforms++] = {fields[p].displacement_x, fields[p].displacement_y};
  }

  const auto fill = [&](int transform, int column0, float* re, float* im) {
    const auto n = static_cast<std::size_t>(transform);
    if (n < patches) return fills.both(state.patches[n], state.plan, t_s, column0, re, im);
    if (n >= first_displaced)
      return fill_displacements(state.patches[displaced[n - first_displaced]], state.plan, t_s,
                                column0, re, im);
    const std::size_t p = 2 * (n - patches);
    const PatchWaves* const other = p + 1 < patches ? &state.patches[p + 1] : nullptr;
    return fills.third(state.patches[p], other, state.plan, t_s, column0, re, im);
  };
  inverse_fft_2d(state.plan, fill, {outputs.data(), transforms}, planes, workers);
}

}  // namespace swell::ocean
