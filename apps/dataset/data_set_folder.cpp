#include "apps/dataset/data_set_folder.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "apps/dataset/contact_sheet.h"
#include "apps/dataset/recipe_files.h"
#include "apps/dataset/sample_record.h"
#include "apps/shared/output_file.h"
#include "apps/shared/version.h"

namespace swell::apps {
namespace {

namespace fs = std::filesystem;

constexpr const char *kAnnotations = "annotations.json", *kContactSheet = "contact.png",
                     *kManifest = "manifest.txt";

[[noreturn]] void refuse(const fs::path& folder, const std::string& got, std::string_view allowed) {
  throw texture::FileError(
      fmt::format("{}: folder of a data set, got {}, allowed {}", folder.string(), got, allowed));
}

const fs::path& made(const fs::path& folder, DataSetFolder::Use use) {
  std::error_code error;
  if (use == DataSetFolder::Use::kFill) fs::create_directories(folder, error);
  if (error) refuse(folder, fmt::format("'{}'", error.message()), "one that can be written to");
  return folder;
}

std::string record_name(int sample) { return sample_file("records", sample, "json"); }

void write_text_file(const texture::OutputFolder& folder, const std::string& name,
                     const std::string& text) {
  write_output(folder, name, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::optional<SampleRecord> read_record(const texture::OutputFolder& folder,
                                        const std::string& name) {
  const auto bytes = folder.read(name);
  return bytes ? parse_record(*bytes) : std::nullopt;
}

Json categories_json(const std::vector<Category>& categories) {
  Json json = Json::array();
  for (const Category& category : categories)
    json.push_back({{"id", category.id}, {"name", category.name}});
  return json;
}

std::vector<SheetBox> boxes_of(const Json& annotations) {
  std::vector<SheetBox> boxes;
  for (const Json& annotation : annotations) {
    const Json& b = annotation["bbox"];
    boxes.push_back({b[0], b[1], b[2], b[3], annotation["category_id"]});
  }
  return boxes;
}

}  // namespace

DataSetFolder::DataSetFolder(const fs::path& folder, const scene::Recipe& recipe, bool has_labels,
                             Use use)
    : recipe_(recipe),
      recipe_hash_(recipe_hash(recipe)),
      has_labels_(has_labels),
      folder_(made(folder, use)),
      is_whole_(static_cast<std::size_t>(recipe.count)) {
  if (use == Use::kFill) make_folders();
  check_recipe();
  read_manifest();
}

void DataSetFolder::make_folders() const {
  folder_.make("");
  for (const char* const name : {"images", "labels", "classes", "instances", "camera", "records"})
    if (has_labels_ || name != std::string_view("labels")) folder_.make(name);
}

// One whole record shows which recipe's samples these are.
void DataSetFolder::check_recipe() {
  for (const std::string& name : folder_.names("records")) {
    const auto record = read_record(folder_, "records/" + name);
    if (!record || (record->has_hash && !record->is_whole)) continue;
    has_older_records_ = !record->has_hash;
    if (record->recipe == recipe_hash_) return;
    if (has_older_records_ && record->recipe == recipe_hash_without_files(recipe_)) return;
    refuse(folder_.path(), "samples of another recipe, scene, or state of its scene's files",
           "a new folder or what they were drawn from");
  }
}

// Lines that are none are left out: their files are looked at without them.
void DataSetFolder::read_manifest() {
  const auto bytes = folder_.read(kManifest);
  if (!bytes) return;
  const std::string text(bytes->begin(), bytes->end());
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    const std::size_t middle = line.find("  ");
    if (middle != std::string::npos) manifest_[line.substr(middle + 2)] = line.substr(0, middle);
    begin = end + 1;
  }
}

std::vector<std::string> DataSetFolder::files_of(int sample) const {
  std::vector<std::string> files = {
      sample_file("images", sample, "png"), sample_file("classes", sample, "png"),
      sample_file("instances", sample, "png"), sample_file("camera", sample, "json")};
  if (has_labels_) files.push_back(sample_file("labels", sample, "exr"));
  return files;
}

std::string DataSetFolder::hash_of(const std::string& name) const {
  const auto bytes = folder_.read(name);
  return bytes ? file_hash(*bytes) : "none";
}

std::string DataSetFolder::check_record(int sample) const {
  const std::string name = record_name(sample);
  const auto record = read_record(folder_, name);
  const std::vector<std::string> files = files_of(sample);
  const bool is_older = record && !record->has_hash;
  if (!record || (record->recipe != recipe_hash_ && !is_older) || record->sample != sample)
    return name + ": no record of this recipe's";
  for (const std::string& file : files)
    if (!record->files.contains(file) || record->files[file] != Json(hash_of(file)))
      return file + ": not what its record says";
  if (is_older) return name + ": without a hash over itself, as earlier versions wrote it";
  if (!record->is_whole || record->files.size() != files.size())
    return name + ": not what its own hash says";
  return "";
}

bool DataSetFolder::is_as_manifest_says(int sample) const {
  std::vector<std::string> files = files_of(sample);
  files.push_back(record_name(sample));
  return std::ranges::all_of(files, [&](const std::string& file) {
    const auto line = manifest_.find(file);
    return line == manifest_.end() || line->second == hash_of(file);
  });
}

bool DataSetFolder::has(int sample) {
  const bool is_whole = check_record(sample).empty() && is_as_manifest_says(sample);
  is_whole_[static_cast<std::size_t>(sample)] = is_whole;
  return is_whole;
}

void DataSetFolder::write(int sample, const Sample& files) {
  Json hashes = Json::object();
  for (const SampleFile& file : files.files) {
    write_output(folder_, file.name, file.bytes);
    hashes[file.name] = file_hash(file.bytes);
  }
  const Json record = {{"recipe", recipe_hash_},
                       {"sample", sample},
                       {"files", hashes},
                       {"facts", Json::parse(files.facts)}};
  write_text_file(folder_, record_name(sample), record_text(record));
  is_whole_[static_cast<std::size_t>(sample)] = true;
}

std::string DataSetFolder::missing() const {
  for (int n = 0; n < recipe_.count; ++n) {
    if (is_whole_[static_cast<std::size_t>(n)]) continue;
    if (std::string fault = check_record(n); !fault.empty()) return fault;
  }
  return "";
}

void DataSetFolder::finish(const ClassSet& classes) const {
  Json images = Json::array(), annotations = Json::array();
  std::map<std::string, std::string> manifest;
  ContactSheet sheet(recipe_.count, recipe_.width_px, recipe_.height_px);
  for (int n = 0; n < recipe_.count; ++n) {
    const auto record = read_record(folder_, record_name(n));
    if (!record || !record->is_whole)
      throw texture::FileError((folder_.path() / record_name(n)).string() +
                               ": changed by another program while the data set was drawn");
    images.push_back(record->facts["image"]);
    const Json& own = record->facts["annotations"];
    annotations.insert(annotations.end(), own.begin(), own.end());
    for (const auto& [file, hash] : record->files.items()) manifest[file] = hash;
    manifest[record_name(n)] = hash_of(record_name(n));
    if (sheet.shows(n))
      sheet.add(n, folder_.path() / sample_file("images", n, "png"), boxes_of(own));
  }
  const Json coco = {{"info",
                      {{"description", recipe_.file.stem().string()},
                       {"version", version()},
                       {"recipe", recipe_hash_},
                       {"classes", recipe_.classes},
                       {"pixel_classes", categories_json(classes.pixel_classes())}}},
                     {"licenses", Json::array()},
                     {"images", images},
                     {"annotations", annotations},
                     {"categories", categories_json(classes.categories())}};
  write_text_file(folder_, kAnnotations,
                  coco.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  write_output(folder_, kContactSheet, sheet.encode());
  for (const char* const name : {kAnnotations, kContactSheet}) manifest[name] = hash_of(name);
  std::string text;
  for (const auto& [name, hash] : manifest) text += fmt::format("{}  {}\n", hash, name);
  write_text_file(folder_, kManifest, text);
}

std::string DataSetFolder::fault() const {
  for (int n = 0; n < recipe_.count; ++n)
    if (std::string fault = check_record(n); !fault.empty()) return fault;
  if (!folder_.read(kManifest)) return std::string(kManifest) + ": not there";
  for (const auto& [name, hash] : manifest_)
    if (hash_of(name) != hash) return name + ": not what manifest.txt says";
  std::vector<std::string> wanted = {kAnnotations, kContactSheet};
  for (int n = 0; n < recipe_.count; ++n) {
    wanted.push_back(record_name(n));
    std::ranges::copy(files_of(n), std::back_inserter(wanted));
  }
  for (const std::string& name : wanted)
    if (!manifest_.contains(name)) return fmt::format("{}: lacks {}", kManifest, name);
  return "";
}

}  // namespace swell::apps
