#include "apps/dataset/sample_record.h"

#include <algorithm>

#include "apps/dataset/recipe_files.h"

namespace swell::apps {
namespace {

constexpr const char* kHashKey = "hash";

std::string hash_of(const Json& content) {
  const std::string text = content.dump();
  return file_hash({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

bool has_shape(const Json& record) {
  const auto is = [&](const char* key, auto is_kind) {
    const auto value = record.find(key);
    return value != record.end() && ((*value).*is_kind)();
  };
  return record.is_object() && is("recipe", &Json::is_string) &&
         is("sample", &Json::is_number_integer) && is("files", &Json::is_object) &&
         is("facts", &Json::is_object);
}

}  // namespace

std::string record_text(const Json& content) {
  Json record = content;
  record[kHashKey] = hash_of(content);
  return record.dump() + "\n";
}

std::optional<SampleRecord> parse_record(std::span<const std::uint8_t> bytes) {
  Json json = Json::parse(bytes.begin(), bytes.end(), nullptr, false);
  if (!has_shape(json)) return std::nullopt;
  SampleRecord record;
  record.has_hash = json.erase(kHashKey) > 0;
  // A number that is written in another way, or a space, is a changed byte too. Text that is no
  // UTF-8 has no dump, but does not pass the parser either.
  record.is_whole =
      record.has_hash && std::ranges::equal(record_text(json), bytes, [](char a, std::uint8_t b) {
        return static_cast<std::uint8_t>(a) == b;
      });
  record.recipe = json["recipe"].get<std::string>();
  record.sample = json["sample"].get<int>();
  record.files = std::move(json["files"]);
  record.facts = std::move(json["facts"]);
  return record;
}

}  // namespace swell::apps
