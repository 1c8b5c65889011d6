#include "texture/improved_noise.h"

#include "texture/lattice.h"

namespace swell::texture {
namespace {

constexpr std::array<std::uint8_t, 256> kPerlinPermutation = {
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103,
    30,  69,  142, 8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,
    197, 62,  94,  252, 219, 203, 117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174,
    20,  125, 136, 171, 168, 68,  175, 74,  165, 71,  134, 139, 48,  27,  166, 77,  146, 158, 231,
    83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,  55,  46,  245, 40,  244, 102, 143,
    54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,  18,  169, 200, 196,
    135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250, 124,
    123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,
    182, 189, 28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101,
    155, 167, 43,  172, 9,   129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185,
    112, 104, 218, 246, 97,  228, 251, 34,  242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,
    51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,  181, 199, 106, 157, 184, 84,  204, 176,
    115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114, 67,  29,  24,  72,  243,
    141, 128, 195, 78,  66,  215, 61,  156, 180};

double fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

// Dot product of (x, y, z) with one of the twelve directions to the middles of a cube's edges
// (four of them twice).
double gradient_dot(int hash, double x, double y, double z) {
  const int h = hash & 15;
  const double first = h < 8 ? x : y;
  const double second = h < 4 ? y : (h == 12 || h == 14 ? x : z);
  return ((h & 1) != 0 ? -first : first) + ((h & 2) != 0 ? -second : second);
}

}  // namespace

ImprovedNoise::ImprovedNoise() {
  for (std::size_t i = 0; i < p_.size(); ++i) p_[i] = kPerlinPermutation[i & 255];
}

ImprovedNoise::ImprovedNoise(std::uint64_t seed) : p_(make_permutation(seed)) {}

double ImprovedNoise::noise3(double x, double y, double z, int period) const {
  const LatticePosition px = lattice_position(x, period), py = lattice_position(y, period);
  const LatticePosition pz = lattice_position(z, period);
  const double u = fade(px.fraction), v = fade(py.fraction), w = fade(pz.fraction);
  const int wrap = period - 1;
  const auto corner = [&](int di, int dj, int dk) {
    const int hash =
        p_[p_[p_[(px.cell + di) & wrap] + ((py.cell + dj) & wrap)] + ((pz.cell + dk) & wrap)];
    return gradient_dot(hash, px.fraction - di, py.fraction - dj, pz.fraction - dk);
  };
  const auto edge = [&](int dj, int dk) { return mix(corner(0, dj, dk), corner(1, dj, dk), u); };
  const auto face = [&](int dk) { return mix(edge(0, dk), edge(1, dk), v); };
  return mix(face(0), face(1), w);
}

}  // namespace swell::texture
