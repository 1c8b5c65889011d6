// The shape of the sea at time t: spectrum waves made by inverse FFT on periodic patches, plus
// explicit sine waves. z = H(x, y, t) is a height field; mean level 0, z up, metres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "math/elementary.h"
#include "math/parallel.h"
#include "ocean/open_sea/map_layer.h"
#include "ocean/open_sea/patch_tiles.h"
#include "ocean/spectrum/limits.h"
#include "ocean/spectrum/spectrum.h"
#include "ocean/wakes/wake_sources.h"

namespace swell::ocean {

// So many of the longest patches are tiled: what the next ones hold is too short to be seen from
// where they would be seen to repeat themselves.
inline constexpr std::size_t kTiledPatches = 1;

// One explicit wave: A sin(k . x - 2 pi t / T + phase).
struct SineWave {
  double amplitude_m = 0.0;
  double wavelength_m = 1.0;
  double to_rad = 0.0;  // direction of travel, clockwise from north
  double phase_rad = 0.0;
  double period_s = 0.0;  // 0: from deep-water dispersion, omega^2 = g k

  bool operator==(const SineWave&) const = default;
};

// Waves that another wind left behind, besides the wind's own: a narrow JONSWAP spectrum.
struct Swell {
  double hs_m = 1.0;                       // significant height, [0, 30]
  double tp_s = 12.0;                      // period of the peak, [1, 40]
  double from_rad = 0.0;                   // where it comes FROM, clockwise from north
  double gamma = 3.3;                      // enhancement of the peak, [1, 20]
  double spread_rad = 15.0 * kPi / 180.0;  // standard deviation of the directions, [1, 60] degrees

  bool operator==(const Swell&) const = default;
};

struct SeaDescription {
  // The wind's own waves, with Hasselmann's directions: by default Pierson and Moskowitz's spectrum
  // of a fully developed sea, none if wind_speed_mps == 0.
  bool spectrum = true;
  double wind_speed_mps = 15.0;  // U10, at 10 m height, [0, 60]
  double wind_from_rad = 0.0;    // where the wind comes FROM, clockwise from north
  // In place of the fully developed sea: water that the wind has blown over, (0, 10000]; or the
  // significant height [0, 30] and the peak's period [0.5, 40], each of which follows from the
  // other if it is left out, and from the wind if both are.
  std::optional<double> fetch_km = {};
  std::optional<double> hs_m = {}, tp_s = {};
  std::optional<double> gamma = {};  // the peak's enhancement, [1, 20]; none: 3.3 with a fetch or 1
  std::vector<Swell> swells = {};    // at most kMaxSwells
  double amplitude_scale = 1.0;  // multiplies the heights of wind waves, swells and maps, [0, 4]
  double gravity_mps2 = 9.81;
  // The sea repeats itself after this time, 0: never, else [1, 100000]. Every wave, sines too, has
  // a whole number n >= 1 of periods in it: the number nearest to its own, so that its speed is
  // within 1/(2n) of what it would be without (waves of less than half a period a loop: faster).
  double loop_s = 0.0;
  std::uint64_t seed = 1;
  int resolution = 128;  // FFT points per side, power of two in [16, 512]
  // 1 to kMaxPatches lengths, longest first. Each patch holds the waves that the next longer one is
  // too coarse for: bands of wave numbers do not overlap.
  std::vector<double> patch_lengths_m = {640.0, 97.0, 17.0};
  // The longest patch covers the sea by tiles that differ (ocean/open_sea/patch_tiles.h); false: it
  // repeats itself as the others do.
  bool tiling = true;
  std::vector<SineWave> sines;  // at most kMaxSines
  // Waves from maps, without sharp crests and foam: those of a set, and others. The patches of the
  // spectrum and the layers of both together are at most kMaxPatches.
  MapSet map_set = MapSet::kNone;
  std::vector<MapLayer> maps;
  MapHeights map_heights = MapHeights::kExact;
  // Crests sharper than troughs: 0 for linear waves to 1 for waves of second order in their
  // steepness (ocean/open_sea/crests.h), [0, 1].
  double choppiness = 0.0;
  double whitecaps = 1.0;  // multiplies the part of the sea that foam covers, [0, 10]

  bool has_maps() const { return map_set != MapSet::kNone || !maps.empty(); }
  // Whether it has a wind that raises waves, and so ripples.
  bool has_wind_waves() const { return spectrum || has_maps(); }

  bool operator==(const SeaDescription&) const = default;
};

// The wind's own waves and the swells that a sea has, without those of no height.
std::vector<WaveSystem> wave_systems(const SeaDescription& sea);

// One patch at one time: resolution x resolution samples, periodic; sample [j * resolution + i] is
// at world x = i L_x / n, y = j L_y / n, in a tile moved by that tile's offset.
struct PatchFrame {
  glm::dvec2 length_m{0.0};  // L_x and L_y; the spectrum's patches are square
  int resolution = 0;
  std::vector<float> height_m, slope_x, slope_y;  // slope = dH/dx, dH/dy from the same spectrum
  // Mean square slope (both axes together) of the waves in the patch: a constant of the sea state.
  float slope_variance = 0.0f;
  PatchTiling tiling;
  // Of packed heights (MapHeights), else empty: sample (i, j) has those of (i, j), (i + 1, j),
  // (i, j + 1) and (i + 1, j + 1), from the low 16 bits up, as signed numbers of steps.
  std::vector<std::uint64_t> height_quads;
  float height_step_m = 0.0f;
  // These are for sharp crests (ocean/open_sea/crests.h), else empty: how far the linear waves have
  // displaced the water that is at a sample; with choppiness c it rests at the sample's place less
  // c times this.
  std::vector<float> displaced_x_m, displaced_y_m;
};

// A sine wave at one time, for SIMD evaluation: amplitude sin(2 pi (cycles_per_m . x + cycles)).
struct SineFrame {
  glm::dvec2 cycles_per_m{0.0};
  double cycles = 0.0;  // in [0, 1)
  double amplitude_m = 0.0;
};

struct SeaFrame {
  double t_s = 0.0;
  // The patches of the spectrum come first, if it has waves, then those of the maps; of either the
  // longest first.
  std::vector<PatchFrame> patches;
  std::vector<SineFrame> sines;
  WakeFrame wakes;                        // advance_wakes() fills it, not advance()
  bool sheltered = true;                  // by land (ocean/coast/shelter.h); advance() leaves it
  bool has_fronts = true;                 // that lift the water, if there are some; likewise
  std::vector<float> linear, fft_planes;  // working storage of advance()
};

// A sea state, built once and then read-only.
class Sea {
 public:
  // Throws std::invalid_argument naming the value and its allowed range.
  explicit Sea(const SeaDescription& description);
  ~Sea();
  Sea(Sea&&) noexcept;
  Sea& operator=(Sea&&) noexcept;

  const SeaDescription& description() const;

  // A bound on |H| in m that holds everywhere and always in practice: 6 standard deviations of the
  // patches and maps, and the sum of the sines' amplitudes with their second order.
  double height_bound_m() const;
  // Bounds |dH/dx| and |dH/dy| likewise, with what the blending of tiles adds to the patches'.
  double slope_bound() const;
  // A height bound of the waves of all patches but the `longest_patches` longest, without sines.
  double short_wave_bound_m(std::size_t longest_patches) const;

  // 4 sqrt(m0) of the waves the patches can hold, sines included; m0 is the mean over time and
  // place of the waves that were drawn for this seed.
  double significant_height_m() const;

  // 2 pi / the mean wave number of the same waves, weighted by their variances; 0 without waves.
  double mean_wavelength_m() const;

  struct State;
  const State& state() const { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

// Fills `frame` with the sea at time t_s (any finite double; the result depends on nothing else).
// With a loop, times that are exactly whole loops apart give the same bits.
// Allocates nothing once the frame has been filled from a sea of this size. Three patches of
// 128 x 128: about 0.2 ms on one thread; of 256 x 256: 1 ms. Sharp crests add 0.15 ms a patch.
// Without sharp_crests the patches' waves stay linear, whatever the sea's choppiness.
void advance(const Sea& sea, double t_s, SeaFrame& frame, Workers& workers,
             bool sharp_crests = true);

// Heights at world points, from the frame's patches (bilinear between samples) and sines.
// Positions in a patch are rounded to 1/65536 of the sample spacing, so that samples come back
// exactly and patches that are not tiled repeat exactly. p_world and height_m have the same length
// and do not overlap; |p_world| below 1e9 m. May be called from many threads at once. 8 ns a point
// for three patches. With `longest_patches` only so many patches, longest first, count, and the
// sines.
void sample_heights(const SeaFrame& frame, std::span<const glm::dvec2> p_world,
                    std::span<float> height_m, std::size_t longest_patches = SIZE_MAX);

// Samples heights at origin_world + offset, for points around an eye: faster than above, and exact
// to the float rounding of the offsets (0.1 mm at 1 km).
void sample_heights(const SeaFrame& frame, glm::dvec2 origin_world,
                    std::span<const glm::vec2> offset_m, std::span<float> height_m);

// dH/dx and dH/dy at world points, both spans as long as p_world: of the spectrum waves the
// slopes in the patches, bilinear between samples, with what the blend of tiles adds, of the sines
// the derivatives. Otherwise as sample_heights().
void sample_slopes(const SeaFrame& frame, std::span<const glm::dvec2> p_world,
                   std::span<float> slope_x, std::span<float> slope_y);

}  // namespace swell::ocean
