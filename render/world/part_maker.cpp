#include "render/world/part_maker.h"

#include "render/world/world_state.h"
#include "scene/file/key_values.h"

namespace swell::render {

PartMaker::PartMaker(const scene::Scene& scene, std::span<const World* const> like,
                     PartCache& cache, MakingReport& report, KeptParts& kept)
    : scene_(scene), like_(like), cache_(cache), report_(report), kept_(kept) {}

ValueBytes PartMaker::of(std::initializer_list<std::string_view> keys) const {
  ValueBytes bytes;
  scene::add_key_values(scene_, {keys.begin(), keys.size()}, bytes);
  return bytes;
}

const std::shared_ptr<const void>* PartMaker::find(const ValueHash& key) {
  const auto in = [&](const KeptParts& parts) {
    const auto found = parts.find(key);
    return found == parts.end() ? nullptr : &found->second;
  };
  for (const World* const world : like_)
    if (const auto* const found = in(world->state().parts)) return found;
  const std::lock_guard lock(mutex_);
  return in(kept_);
}

std::shared_ptr<const void> PartMaker::keep(const ValueHash& key,
                                            std::shared_ptr<const void> part) {
  const std::lock_guard lock(mutex_);
  return kept_.emplace(key, std::move(part)).first->second;
}

}  // namespace swell::render
