// Parts of a picture that can be left out: to see what each costs, or not to have it. This one
// table names them for code, options and reports.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string_view>

#include "math/enum_table.h"

namespace swell::render {

enum class Part : std::uint8_t {
  kWater,          // the sea: without it the land goes on dry, and things lie where they did
  kReflection,     // what the water mirrors besides the sky
  kRefraction,     // what lies under the water's surface
  kRipples,        // the water's waves too short for the wave patches
  kGlitter,        // the sun's image in the water seen from above
  kWhitecaps,      // foam of the open sea
  kHaze,           // between the eye and what it sees
  kEarth,          // its curve: without it the sea is flat
  kClouds,         // in the sky, and in what the water mirrors of it
  kShadows,        // of land and objects before sun or moon
  kHulls,          // foam and dark water where floating things meet it
  kApron,          // the ground beyond the terrain's square
  kTiling,         // what tells the places of a wave patch apart; queries of the sea keep it
  kVisibleSlopes,  // that of rough water slopes turned to the eye are seen, and others are not
  kCrests,         // what makes the open sea's crests sharper than troughs; queries keep it
  kAltitude,       // what the eye's height changes in the sky and in the air below it
  kTextures,       // pictures on meshes: each is its mean colour
  kUnderwater,     // what an eye below the surface sees; without it, it sees through air
  kMeniscus,       // the dark line where the surface cuts the picture
  kCaustics,       // the sun's light, gathered by the waves: shafts and uplight as well
  kShafts,         // it in the water between the eye and what it sees
  kUplight,        // it on objects above the water, from below
  kSequence,       // a scene's sequence of bump images; without it, layers that drift
  kSunTexture,     // a scene's projected glitter; without it, that of slopes
  kCausticBend,    // how ripples move a scene's caustics
  kSelfShadows,    // of objects on themselves
  kImageBlur,      // what slopes finer than a pixel spread in the planar maps
  kWakes,          // waves and foam of what disturbs the water
  kMaps,           // waves of periodic maps; queries keep them
  kLandDetail,     // what the ground is made of, finer than its maps; how much sky valleys see
  kTrees,          // and reeds, with what they are of the land's colour and shade
  kFog,            // over the sea
  kStars,          // of the night sky
  kVolumeClouds,   // of [clouds], before and behind things, and mirrored
  kCloudShadows,   // of all clouds on sea and land, in fog and water
  kImplicits,      // objects made of functions
  kShelter,        // what land takes of the open sea's waves; queries and trains keep it
  kSurfFronts,     // foam of surf where no trains are, and its waves; queries keep these
  kRivers,         // rivers and lakes: their beds lie dry; queries keep them
};
inline constexpr std::size_t kPartCount = kEnumerators<Part>;

// Words of lower-case letters and '-'.
inline constexpr auto kPartNames = enum_words<Part>({
    {Part::kWater, "water"},
    {Part::kReflection, "reflection"},
    {Part::kRefraction, "refraction"},
    {Part::kRipples, "ripples"},
    {Part::kGlitter, "glitter"},
    {Part::kWhitecaps, "whitecaps"},
    {Part::kHaze, "haze"},
    {Part::kEarth, "earth"},
    {Part::kClouds, "clouds"},
    {Part::kShadows, "shadows"},
    {Part::kHulls, "hulls"},
    {Part::kApron, "apron"},
    {Part::kTiling, "tiling"},
    {Part::kVisibleSlopes, "seen-slopes"},
    {Part::kCrests, "crests"},
    {Part::kAltitude, "altitude"},
    {Part::kTextures, "textures"},
    {Part::kUnderwater, "underwater"},
    {Part::kMeniscus, "meniscus"},
    {Part::kCaustics, "caustics"},
    {Part::kShafts, "shafts"},
    {Part::kUplight, "uplight"},
    {Part::kSequence, "sequence"},
    {Part::kSunTexture, "sun-slide"},
    {Part::kCausticBend, "caustic-bend"},
    {Part::kSelfShadows, "own-shadows"},
    {Part::kImageBlur, "image-blur"},
    {Part::kWakes, "wakes"},
    {Part::kMaps, "maps"},
    {Part::kLandDetail, "land-detail"},
    {Part::kTrees, "trees"},
    {Part::kFog, "fog"},
    {Part::kStars, "stars"},
    {Part::kVolumeClouds, "volume-clouds"},
    {Part::kCloudShadows, "cloud-shadows"},
    {Part::kImplicits, "forms"},
    {Part::kShelter, "shelter"},
    {Part::kSurfFronts, "surf-fronts"},
    {Part::kRivers, "rivers"},
});
constexpr std::string_view part_name(Part part) { return kPartNames[part]; }

class PartSet {
 public:
  constexpr PartSet() = default;
  constexpr PartSet(std::initializer_list<Part> parts) {
    for (const Part part : parts) add(part);
  }
  constexpr bool has(Part part) const { return (bits_ >> static_cast<unsigned>(part) & 1) != 0; }
  constexpr void add(Part part) { bits_ |= std::uint64_t{1} << static_cast<unsigned>(part); }
  constexpr void add(PartSet parts) { bits_ |= parts.bits_; }
  constexpr bool empty() const { return bits_ == 0; }
  bool operator==(const PartSet&) const = default;

 private:
  static_assert(kPartCount <= 64);
  std::uint64_t bits_ = 0;
};

// "ripples,haze"; nothing for a name that is not in the table, or none.
constexpr std::optional<PartSet> parse_parts(std::string_view text) {
  PartSet set;
  for (;;) {
    const std::string_view name = text.substr(0, text.find(','));
    const auto at = std::ranges::find(kPartNames, name);
    if (at == kPartNames.end()) return std::nullopt;
    set.add(static_cast<Part>(at - kPartNames.begin()));
    if (name.size() == text.size()) return set;
    text.remove_prefix(name.size() + 1);
  }
}

}  // namespace swell::render
