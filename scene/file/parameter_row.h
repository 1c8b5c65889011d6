// How the rows of the table of parameters are made (scene/file/parameters.cpp).
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "math/enum_table.h"
#include "scene/file/parameters.h"
#include "scene/file/shortest_number.h"

namespace swell::scene {

inline constexpr double kMaxSeed = 9007199254740992.0;  // 2^53

// Makes rows of the table. `Field` is the type of a captureless lambda from the object to a
// reference to the field.
template <class Object>
struct Row {
  using Value = ParameterValue;
  struct Range {
    double low, high;
    std::string_view unit = "";
  };

  template <class Field>
  static Parameter<Object> number(std::string_view key, Range range, Field,
                                  std::string_view meaning) {
    Parameter<Object> row = ranged<Field>(key, ParameterKind::kNumber, range, meaning);
    row.get = [](const Object& object) -> Value {
      return std::vector<double>{to_file(Field{}(object))};
    };
    row.set = [](Object& object, const Value& value) {
      Field{}(object) = std::get<std::vector<double>>(value)[0];
    };
    return row;
  }

  // A field that may hold no number.
  template <class Field>
  static Parameter<Object> optional_number(std::string_view key, Range range, Field,
                                           std::string_view meaning) {
    Parameter<Object> row = ranged<Field>(key, ParameterKind::kNumber, range, meaning);
    row.get = [](const Object& object) -> Value {
      return std::vector<double>{Field{}(object).value_or(0.0)};
    };
    row.set = [](Object& object, const Value& value) {
      Field{}(object) = std::get<std::vector<double>>(value)[0];
    };
    row.is_set = [](const Object& object) { return Field{}(object).has_value(); };
    return row;
  }

  // A field in radians.
  template <class Field>
  static Parameter<Object> angle(std::string_view key, Range range, Field,
                                 std::string_view meaning) {
    Parameter<Object> row = ranged<Field>(key, ParameterKind::kNumber, range, meaning);
    row.get = [](const Object& object) -> Value {
      const double rad = Field{}(object);
      return std::vector<double>{shortest_preimage(rad, rad / kRadPerDeg, radians)};
    };
    row.set = [](Object& object, const Value& value) {
      Field{}(object) = radians(std::get<std::vector<double>>(value)[0]);
    };
    return row;
  }

  // A field in radians that may hold none.
  template <class Field>
  static Parameter<Object> optional_angle(std::string_view key, Range range, Field,
                                          std::string_view meaning) {
    Parameter<Object> row = ranged<Field>(key, ParameterKind::kNumber, range, meaning);
    row.get = [](const Object& object) -> Value {
      const double rad = Field{}(object).value_or(0.0);
      return std::vector<double>{shortest_preimage(rad, rad / kRadPerDeg, radians)};
    };
    row.set = [](Object& object, const Value& value) {
      Field{}(object) = radians(std::get<std::vector<double>>(value)[0]);
    };
    row.is_set = [](const Object& object) { return Field{}(object).has_value(); };
    return row;
  }

  // A number or angle that may be 0 although its range begins above.
  static Parameter<Object> or_zero(Parameter<Object> row) {
    row.zero_too = true;
    return row;
  }

  // A GLM vector.
  template <class Field>
  static Parameter<Object> vector(std::string_view key, Range range, Field,
                                  std::string_view meaning) {
    using Vector = std::remove_cvref_t<decltype(Field{}(std::declval<Object&>()))>;
    Parameter<Object> row = ranged<Field>(key, ParameterKind::kNumbers, range, meaning);
    row.count_low = row.count_high = Vector::length();
    row.get = [](const Object& object) -> Value { return numbers_of(Field{}(object)); };
    row.set = [](Object& object, const Value& value) {
      Field{}(object) = vector_of<Vector>(value);
    };
    return row;
  }

  // A GLM vector whose numbers are the same where the file has but one.
  template <class Field>
  static Parameter<Object> number_or_vector(std::string_view key, Range range, Field field,
                                            std::string_view meaning) {
    Parameter<Object> row = vector(key, range, field, meaning);
    row.one_for_all = true;
    return row;
  }

  // A field that may hold no GLM vector.
  template <class Field>
  static Parameter<Object> optional_vector(std::string_view key, Range range, Field,
                                           std::string_view meaning) {
    using Optional = std::remove_cvref_t<decltype(Field{}(std::declval<Object&>()))>;
    using Vector = typename Optional::value_type;
    Parameter<Object> row = ranged<Field>(key, ParameterKind::kNumbers, range, meaning);
    row.count_low = row.count_high = Vector::length();
    row.get = [](const Object& object) -> Value {
      return numbers_of(Field{}(object).value_or(Vector(0)));
    };
    row.set = [](Object& object, const Value& value) {
      Field{}(object) = vector_of<Vector>(value);
    };
    row.is_set = [](const Object& object) { return Field{}(object).has_value(); };
    return row;
  }

  template <class Field>
  static Parameter<Object> list(std::string_view key, Range range, int count_low, int count_high,
                                Field, std::string_view meaning) {
    Parameter<Object> row =
        plain<std::vector<double>>(key, ParameterKind::kNumbers, Field{}, meaning);
    row.low = range.low, row.high = range.high, row.unit = range.unit;
    row.count_low = count_low, row.count_high = count_high;
    return row;
  }

  template <class Field>
  static Parameter<Object> integer(std::string_view key, ParameterKind kind, Range range, Field,
                                   std::string_view meaning) {
    using Integer = std::remove_cvref_t<decltype(Field{}(std::declval<Object&>()))>;
    Parameter<Object> row = ranged<Field>(key, kind, range, meaning);
    row.get = [](const Object& object) -> Value {
      return static_cast<std::int64_t>(Field{}(object));
    };
    row.set = [](Object& object, const Value& value) {
      Field{}(object) = static_cast<Integer>(std::get<std::int64_t>(value));
    };
    return row;
  }

  // A field that may hold no integer.
  template <class Field>
  static Parameter<Object> optional_integer(std::string_view key, Range range, Field,
                                            std::string_view meaning) {
    Parameter<Object> row = ranged<Field>(key, ParameterKind::kInteger, range, meaning);
    row.get = [](const Object& object) -> Value {
      return static_cast<std::int64_t>(Field{}(object).value_or(0));
    };
    row.set = [](Object& object, const Value& value) {
      Field{}(object) = static_cast<int>(std::get<std::int64_t>(value));
    };
    row.is_set = [](const Object& object) { return Field{}(object).has_value(); };
    return row;
  }

  // A boolean or enumerated field that the file names by one of the words.
  template <class Field>
  static Parameter<Object> choice(std::string_view key, Field, std::string_view meaning) {
    using Chosen = std::remove_cvref_t<decltype(Field{}(std::declval<Object&>()))>;
    static_assert(std::is_same_v<typename decltype(Field::words)::Of, Chosen>);
    Parameter<Object> row = ranged<Field>(key, ParameterKind::kChoice, {}, meaning);
    row.choices = Field::words;
    row.get = [](const Object& object) -> Value {
      const auto index = static_cast<std::size_t>(Field{}(object));  // of a scene made in code: any
      return index < Field::words.size() ? std::string(Field::words[index])
                                         : fmt::format("value {}", index);
    };
    row.set = [](Object& object, const Value& value) {
      using Stored = std::remove_cvref_t<decltype(Field{}(object))>;
      const auto word = std::ranges::find(Field::words, std::get<std::string>(value));
      Field{}(object) = static_cast<Stored>(word - Field::words.begin());
    };
    return row;
  }

  // A list of GLM vectors of two, without a value when empty.
  template <class Field>
  static Parameter<Object> points(std::string_view key, Range range, int count_low, int count_high,
                                  Field, std::string_view meaning) {
    Parameter<Object> row = ranged<Field>(key, ParameterKind::kPoints, range, meaning);
    row.count_low = count_low, row.count_high = count_high;
    row.get = [](const Object& object) -> Value {
      std::vector<double> numbers;
      for (const glm::dvec2& point : Field{}(object)) {
        numbers.push_back(point.x);
        numbers.push_back(point.y);
      }
      return numbers;
    };
    row.set = [](Object& object, const Value& value) {
      const auto& numbers = std::get<std::vector<double>>(value);
      Field{}(object).clear();
      for (std::size_t i = 0; i < numbers.size(); i += 2)
        Field{}(object).emplace_back(numbers[i], numbers[i + 1]);
    };
    row.is_set = [](const Object& object) { return !Field{}(object).empty(); };
    return row;
  }

  // A field that holds what the file has: a boolean, text, a path, a list.
  template <class Stored, class Field>
  static Parameter<Object> plain(std::string_view key, ParameterKind kind, Field,
                                 std::string_view meaning) {
    Parameter<Object> row = ranged<Field>(key, kind, {}, meaning);
    row.get = [](const Object& object) -> Value { return Stored(Field{}(object)); };
    row.set = [](Object& object, const Value& value) { Field{}(object) = std::get<Stored>(value); };
    return row;
  }

  // Text, without a value when empty.
  template <class Field>
  static Parameter<Object> optional_text(std::string_view key, Field, std::string_view meaning) {
    Parameter<Object> row = plain<std::string>(key, ParameterKind::kText, Field{}, meaning);
    row.is_set = [](const Object& object) { return !Field{}(object).empty(); };
    return row;
  }

  // The path of files that a number in the name tells apart.
  template <class Field>
  static Parameter<Object> frame_paths(std::string_view key, Field, std::string_view meaning) {
    Parameter<Object> row = plain<std::string>(key, ParameterKind::kPath, Field{}, meaning);
    row.is_of_frames = true;
    return row;
  }

 private:
  template <class Vector>
  static std::vector<double> numbers_of(const Vector& v) {
    std::vector<double> numbers;
    for (int i = 0; i < Vector::length(); ++i) numbers.push_back(to_file(v[i]));
    return numbers;
  }

  template <class Vector>
  static Vector vector_of(const Value& value) {
    const auto& numbers = std::get<std::vector<double>>(value);
    Vector v(0);
    for (int i = 0; i < Vector::length(); ++i)
      v[i] = static_cast<typename Vector::value_type>(numbers[i]);
    return v;
  }

  template <class Field>
  static Parameter<Object> ranged(std::string_view key, ParameterKind kind, Range range,
                                  std::string_view meaning) {
    Parameter<Object> row;
    row.add_value = [](const Object& object, ValueBytes& to) { to.add(Field{}(object)); };
    row.key = key, row.kind = kind, row.meaning = meaning;
    row.low = range.low, row.high = range.high, row.unit = range.unit;
    return row;
  }
};

}  // namespace swell::scene
