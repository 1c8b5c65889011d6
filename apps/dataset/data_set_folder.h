// The folder of a data set: whole samples with their records, and what is made of all of them.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "apps/dataset/class_sets.h"
#include "apps/dataset/sample.h"
#include "scene/recipe.h"

namespace swell::apps {

// A sample is there once its record is, which is written last: the hashes of its files and its part
// of annotations.json. Several processes may fill one folder.
class DataSetFolder {
 public:
  // Makes what is missing of the folders. Throws texture::FileError if they cannot be written to,
  // or hold samples of another recipe. The recipe must outlive this.
  DataSetFolder(std::filesystem::path folder, const scene::Recipe& recipe, bool has_labels);

  // Whether the sample's record is there and all its files have the hashes that it says.
  bool has(int sample) const;

  // Writes a sample's files, then its record. Throws texture::FileError.
  void write(int sample, const Sample& files) const;

  // Whether all samples of the recipe have records.
  bool is_complete() const;

  // Writes annotations.json, contact.png, then manifest.txt with the hash of every file. Call it
  // when the data set is complete; the bytes follow from the samples.
  void finish(const ClassSet& classes) const;

  // What is wrong with the files against the manifest; empty if nothing is.
  std::string fault() const;

 private:
  std::filesystem::path record_path(int sample) const;
  std::string check_record(int sample, bool with_files) const;

  std::filesystem::path folder_;
  const scene::Recipe& recipe_;
  std::string recipe_hash_;
};

// XXH3-128 as xxh128sum prints it.
std::string file_hash(std::span<const std::uint8_t> bytes);

}  // namespace swell::apps
