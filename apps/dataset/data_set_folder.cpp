#include "apps/dataset/data_set_folder.h"

#include <fmt/core.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "apps/dataset/contact_sheet.h"
#include "apps/shared/json.h"
#include "apps/shared/output_file.h"
#include "apps/shared/version.h"
#include "texture/image_io.h"

namespace swell::apps {
namespace {

namespace fs = std::filesystem;

using Bytes = std::vector<std::uint8_t>;

std::optional<Bytes> read_bytes(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  Bytes bytes((std::istreambuf_iterator<char>(file)), {});
  if (!file.good() && !file.eof()) return std::nullopt;
  return bytes;
}

Json read_json(const fs::path& path) {
  const std::optional<Bytes> bytes = read_bytes(path);
  return bytes ? Json::parse(*bytes, nullptr, false) : Json();
}

void write_text_file(const fs::path& path, const std::string& text) {
  write_output(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::string hash_of(const fs::path& path) {
  const std::optional<Bytes> bytes = read_bytes(path);
  return bytes ? file_hash(*bytes) : "none";
}

// Of what decides a sample: the recipe but for its count, and its scene.
std::string recipe_hash(const scene::Recipe& recipe) {
  Bytes bytes(recipe.text.begin(), recipe.text.end());
  bytes.push_back(0);
  const Bytes scene = read_bytes(recipe.scene).value_or(Bytes());
  bytes.insert(bytes.end(), scene.begin(), scene.end());
  return file_hash(bytes);
}

Json categories_json(const std::vector<Category>& categories) {
  Json json = Json::array();
  for (const Category& category : categories)
    json.push_back({{"id", category.id}, {"name", category.name}});
  return json;
}

}  // namespace

std::string file_hash(std::span<const std::uint8_t> bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

DataSetFolder::DataSetFolder(fs::path folder, const scene::Recipe& recipe, bool has_labels)
    : folder_(std::move(folder)), recipe_(recipe), recipe_hash_(recipe_hash(recipe)) {
  for (const char* const name : {"images", "labels", "classes", "instances", "camera", "records"}) {
    if (!has_labels && name == std::string_view("labels")) continue;
    std::error_code error;
    fs::create_directories(folder_ / name, error);
    if (error)
      throw texture::FileError(
          fmt::format("{}: folder of a data set, got '{}', allowed one that can be written to",
                      (folder_ / name).string(), error.message()));
    check_output_place(folder_ / name / "file");
  }
  check_output_place(folder_ / "manifest.txt");
  for (const auto& entry : fs::directory_iterator(folder_ / "records")) {
    const Json record = read_json(entry.path());
    if (record.is_object() && record.value("recipe", "") != recipe_hash_)
      throw texture::FileError(
          fmt::format("{}: folder of a data set, got samples of another recipe or scene, allowed a "
                      "new folder or this recipe's own",
                      folder_.string()));
    break;  // one shows it
  }
}

fs::path DataSetFolder::record_path(int sample) const {
  return folder_ / sample_file("records", sample, "json");
}

std::string DataSetFolder::check_record(int sample, bool with_files) const {
  const std::string name = sample_file("records", sample, "json");
  const Json record = read_json(folder_ / name);
  const bool is_record = record.is_object() && record.contains("files") &&
                         record["files"].is_object() && record.contains("facts") &&
                         record["facts"].is_object();
  if (!is_record || record.value("recipe", "") != recipe_hash_)
    return name + ": no record of this recipe's";
  if (!with_files) return "";
  for (const auto& [file, hash] : record["files"].items())
    if (hash != Json(hash_of(folder_ / file))) return file + ": not what its record says";
  return "";
}

bool DataSetFolder::has(int sample) const { return check_record(sample, true).empty(); }

void DataSetFolder::write(int sample, const Sample& files) const {
  Json hashes = Json::object();
  for (const SampleFile& file : files.files) {
    write_output(folder_ / file.name, file.bytes);
    hashes[file.name] = file_hash(file.bytes);
  }
  const Json record = {{"recipe", recipe_hash_},
                       {"sample", sample},
                       {"files", hashes},
                       {"facts", Json::parse(files.facts)}};
  write_text_file(record_path(sample), record.dump() + "\n");
}

bool DataSetFolder::is_complete() const {
  for (int n = 0; n < recipe_.count; ++n)
    if (!check_record(n, false).empty()) return false;
  return true;
}

void DataSetFolder::finish(const ClassSet& classes) const {
  Json images = Json::array(), annotations = Json::array();
  std::vector<std::string> lines;
  const auto add_line = [&](const std::string& hash, const std::string& name) {
    lines.push_back(name + "\n" + hash);
  };
  ContactSheet sheet(recipe_.count, recipe_.width_px, recipe_.height_px);
  for (int n = 0; n < recipe_.count; ++n) {
    const Json record = read_json(record_path(n));
    const Json& facts = record["facts"];
    images.push_back(facts["image"]);
    std::vector<SheetBox> boxes;
    for (const Json& annotation : facts["annotations"]) {
      annotations.push_back(annotation);
      const Json& b = annotation["bbox"];
      boxes.push_back({b[0], b[1], b[2], b[3], annotation["category_id"]});
    }
    for (const auto& [file, hash] : record["files"].items()) add_line(hash, file);
    add_line(hash_of(record_path(n)), sample_file("records", n, "json"));
    if (sheet.shows(n)) sheet.add(n, folder_ / sample_file("images", n, "png"), boxes);
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
  write_text_file(folder_ / "annotations.json",
                  coco.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  write_output(folder_ / "contact.png", sheet.encode());
  for (const char* const name : {"annotations.json", "contact.png"})
    add_line(hash_of(folder_ / name), name);
  std::ranges::sort(lines);
  std::string manifest;
  for (const std::string& line : lines) {
    const std::size_t middle = line.find('\n');
    manifest += fmt::format("{}  {}\n", line.substr(middle + 1), line.substr(0, middle));
  }
  write_text_file(folder_ / "manifest.txt", manifest);
}

std::string DataSetFolder::fault() const {
  for (int n = 0; n < recipe_.count; ++n)
    if (const std::string fault = check_record(n, true); !fault.empty()) return fault;
  std::ifstream manifest(folder_ / "manifest.txt");
  if (!manifest) return "manifest.txt: not there";
  int files = 0;
  for (std::string line; std::getline(manifest, line); ++files) {
    const std::size_t middle = std::min(line.find("  "), line.size());
    const std::string name = line.substr(std::min(middle + 2, line.size()));
    if (hash_of(folder_ / name) != line.substr(0, middle))
      return name + ": not what manifest.txt says";
  }
  if (files < recipe_.count) return "manifest.txt: not of all samples";
  return "";
}

}  // namespace swell::apps
