// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// JSON documents to be written. Parsing is the business of foothold/files/settings_file.h.
#pragma once

#include <initializer_list>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace foothold::apps {

/// A JSON value. Objects keep their members in the order in which they were added.
///
///     Json json = {{"name", "kitchen"}, {"error", {{"median_m", 0.01}, {"max_m", 0.1}}}};
///     json["frames"].push_back(42);
class Json {
 public:
  Json();  ///< null
  Json(std::nullptr_t);
  Json(bool value);
  Json(double value);  ///< null if it is not finite: JSON knows neither NaN nor infinity
  template <class Integer, class = std::enable_if_t<std::is_integral_v<Integer>>>
  Json(Integer value) : Json(Kind::kLiteral, std::to_string(value)) {}
  Json(const char* text);
  Json(const std::string& text);
  Json(const std::vector<std::string>& texts);  ///< an array
  /// An object; two members of one name are not allowed.
  Json(std::initializer_list<std::pair<std::string, Json>> members);

  // The special members are compiled once, in json.cpp.
  Json(const Json&);
  Json(Json&&) noexcept;
  Json& operator=(const Json&);
  Json& operator=(Json&&) noexcept;
  ~Json();

  static Json object();
  static Json array(std::initializer_list<Json> items = {});
  /// A number, true or false if the text is one; otherwise the text.
  static Json from_text(const std::string& text);
  /// Nests {"pose.seed", "42"} as {"pose": {"seed": 42}}, each value by from_text().
  static Json nested(const std::vector<std::pair<std::string, std::string>>& paths_and_values);

  /// The member of this name, null when it is new. @pre The value is an object or null, which becomes one.
  Json& operator[](const std::string& name);
  /// Adds the members of another object, or replaces those of the same name.
  void update(const Json& other);
  void erase(const std::string& name);

  /// Adds an item. @pre The value is an array or null, which becomes one.
  void push_back(Json item);

  bool empty() const { return items_.empty(); }       ///< of an array or object
  std::size_t size() const { return items_.size(); }  ///< of an array or object

  /// The document, a value per line, indented by two spaces a level. Bytes that are not UTF-8 are replaced.
  std::string dump() const;

 private:
  enum class Kind { kLiteral, kText, kArray, kObject };
  Json(Kind kind, std::string text);

  void write(int depth, std::string& out) const;

  Kind kind_ = Kind::kLiteral;
  std::string text_;                ///< a literal as written, or a text as it is
  std::vector<std::string> names_;  ///< of the members of an object, one per item
  std::vector<Json> items_;         ///< of an array or object
};

}  // namespace foothold::apps
