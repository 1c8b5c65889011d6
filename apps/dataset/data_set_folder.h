// The folder of a data set: whole samples with their records, and what is made of all of them.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "apps/dataset/class_sets.h"
#include "apps/dataset/sample.h"
#include "scene/file/recipe.h"
#include "texture/image/output_folder.h"

namespace swell::apps {

// A sample is there once its record is, which is written last: the hashes of its files, its part of
// annotations.json, and a hash over the record itself. Several processes may fill one folder. Below
// the folder no link is followed: one in place of a file is not that file.
class DataSetFolder {
 public:
  enum class Use : std::uint8_t { kFill, kCheck };

  // To fill it, makes what is missing of the folders; to check it, writes nothing. Throws
  // texture::FileError if they cannot be written to, or hold samples of another recipe. The recipe
  // must outlive this.
  DataSetFolder(const std::filesystem::path& folder, const scene::Recipe& recipe, bool has_labels,
                Use use);

  // Whether the folder holds records of an earlier version, which have no hash over themselves.
  // Their samples count as not there.
  bool has_older_records() const { return has_older_records_; }

  // Whether the sample's record is there, with its own hash, and all its files have the hashes that
  // the record says, and the manifest if there is one.
  bool has(int sample);

  // Writes a sample's files, then its record. Throws texture::FileError.
  void write(int sample, const Sample& files);

  // The first thing that is missing or damaged of the recipe's samples; empty if they are complete.
  std::string missing() const;

  // Writes annotations.json, contact.png, then manifest.txt with the hash of every file. Call it
  // when the data set is complete; the bytes follow from the samples.
  void finish(const ClassSet& classes) const;

  // What is wrong with the files against the manifest; empty if nothing is.
  std::string fault() const;

 private:
  void make_folders() const;
  void check_recipe();
  void read_manifest();
  std::vector<std::string> files_of(int sample) const;
  std::string check_record(int sample) const;
  bool is_as_manifest_says(int sample) const;
  std::string hash_of(const std::string& name) const;

  const scene::Recipe& recipe_;
  std::string recipe_hash_;
  bool has_labels_, has_older_records_ = false;
  texture::OutputFolder folder_;
  std::map<std::string, std::string> manifest_;  // hashes by names, as it was at the start
  std::vector<bool> is_whole_;                   // samples that this process has looked at
};

}  // namespace swell::apps
