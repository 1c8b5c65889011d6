// Parts of a world, each made once for all worlds that are made of the same. A part says what goes
// into it: keys of the scene, values, other parts' inputs. By their hash it is found again. A part
// that says what it consists of (math/archive.h) is also found by later processes; it is made of no
// other files than render/world/part_cache.cpp looks into.
//
//   const ValueBytes inputs = parts.of({"clouds"}).add(to_light);
//   state.cloud_volume = parts.share("cloud volume", inputs, [&] { return build_...; });
#pragma once

#include <chrono>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "math/archive.h"
#include "math/stop.h"
#include "math/value_hash.h"
#include "render/world/kept_parts.h"
#include "render/world/making_report.h"
#include "render/world/part_cache.h"
#include "render/world/world.h"

namespace swell::render {

class PartMaker {
 public:
  // A maker of parts for a scene, which takes those that worlds of `like` or the cache have; kept:
  // of the world that is made. All outlive it. `report` is told of each part.
  PartMaker(const scene::Scene& scene, std::span<const World* const> like, PartCache& cache,
            MakingReport& report, KeptParts& kept);

  // What the scene says under these keys (scene/file/key_values.h).
  ValueBytes of(std::initializer_list<std::string_view> keys) const;

  // Returns what make() makes of these inputs, from where it is already: a T, or a std::optional<T>
  // that is null here if it is empty. Parts of one name have one type. May be called by several
  // threads at once; two that ask for the same part at the same time may both make it.
  template <class Make>
  auto share(std::string_view name, ValueBytes inputs, Make&& make) {
    using Made = std::remove_cvref_t<std::invoke_result_t<Make>>;
    const ValueHash key = inputs.add(name).hash();
    if (const std::shared_ptr<const void>* const found = find(key)) {
      report_.has(name);
      return typed<Made>(keep(key, *found));
    }
    check_stop();
    const auto start = MakingReport::Clock::now();
    if constexpr (kHasFields<Made>) {
      if (std::optional<Made> read = cache_.find<Made>(key)) {
        report_.read(name, start);
        return typed<Made>(keep(key, part_of(std::make_shared<Made>(*std::move(read)))));
      }
    }
    const auto made = std::make_shared<Made>(make());
    report_.made(name, start);
    if constexpr (kHasFields<Made>)
      if (MakingReport::Clock::now() - start >= kWorthKeeping) cache_.keep(key, made);
    return typed<Made>(keep(key, part_of(made)));
  }

 private:
  // Reading a file takes a part of this.
  static constexpr std::chrono::milliseconds kWorthKeeping{10};

  template <class T>
  struct Part {
    using Type = T;
  };
  template <class T>
  struct Part<std::optional<T>> {
    using Type = T;
  };
  template <class Made>
  static std::shared_ptr<const typename Part<Made>::Type> typed(
      const std::shared_ptr<const void>& part) {
    return std::static_pointer_cast<const typename Part<Made>::Type>(part);
  }
  template <class T>
  static std::shared_ptr<const void> part_of(std::shared_ptr<T> made) {
    return made;
  }
  template <class T>
  static std::shared_ptr<const void> part_of(std::shared_ptr<std::optional<T>> made) {
    return *made ? std::shared_ptr<const void>(made, &**made) : nullptr;
  }

  const std::shared_ptr<const void>* find(const ValueHash& key);
  std::shared_ptr<const void> keep(const ValueHash& key, std::shared_ptr<const void> part);

  const scene::Scene& scene_;
  std::span<const World* const> like_;
  PartCache& cache_;
  MakingReport& report_;
  KeptParts& kept_;
  std::mutex mutex_;  // of kept_
};

}  // namespace swell::render
