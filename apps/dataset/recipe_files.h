// The files that a recipe's samples are drawn from.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "scene/file/recipe.h"

namespace swell::apps {

// Makes a world with each file that a value of the recipe names, so that what is wrong with one
// shows before anything is drawn. Throws as render::World does.
void try_files(const scene::Recipe& recipe, int threads);

// The hash of what decides a sample: the recipe but for its count, its scene, and the content of
// every file that its scenes name. A mesh counts as what the importer makes of it, and so with its
// buffers, materials and textures. Paths do not count. Throws scene::SceneError for a file that
// cannot be read.
std::string recipe_hash(const scene::Recipe& recipe);

// That of the recipe and its scene alone, as records without hashes of their own have it.
std::string recipe_hash_without_files(const scene::Recipe& recipe);

// XXH3-128 as xxh128sum prints it.
std::string file_hash(std::span<const std::uint8_t> bytes);

}  // namespace swell::apps
