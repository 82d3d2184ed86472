// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "foothold/base/contract.h"

namespace foothold::apps {
namespace {

/// A text or number as JSON has it.
template <class Value>
std::string literal(const Value& value) {
  return nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

Json::Json() : Json(Kind::kLiteral, "null") {}
Json::Json(std::nullptr_t) : Json() {}
Json::Json(bool value) : Json(Kind::kLiteral, value ? "true" : "false") {}
Json::Json(double value) : Json(Kind::kLiteral, literal(value)) {}
Json::Json(const char* text) : Json(Kind::kText, text) {}
Json::Json(const std::string& text) : Json(Kind::kText, text) {}
Json::Json(const std::vector<std::string>& texts) : Json(Kind::kArray, {}) { items_.assign(texts.begin(), texts.end()); }
Json::Json(std::initializer_list<std::pair<std::string, Json>> members) : Json(Kind::kObject, {}) {
  for (const auto& [name, value] : members) {
    names_.push_back(name);
    items_.push_back(value);
  }
}
Json::Json(Kind kind, std::string text) : kind_(kind), text_(std::move(text)) {}
Json::Json(const Json&) = default;
Json::Json(Json&&) noexcept = default;
Json& Json::operator=(const Json&) = default;
Json& Json::operator=(Json&&) noexcept = default;
Json::~Json() = default;

Json Json::object() { return Json(Kind::kObject, {}); }

Json Json::array(std::initializer_list<Json> items) {
  Json json(Kind::kArray, {});
  json.items_ = items;
  return json;
}

Json Json::from_text(const std::string& text) {
  const nlohmann::json value = nlohmann::json::parse(text, nullptr, false);
  return value.is_number() || value.is_boolean() ? Json(Kind::kLiteral, value.dump()) : Json(text);
}

Json Json::nested(const std::vector<std::pair<std::string, std::string>>& paths_and_values) {
  Json result = object();
  for (const auto& [path, value] : paths_and_values) {
    Json* parent = &result;
    std::size_t begin = 0;
    for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', begin)) {
      parent = &(*parent)[path.substr(begin, dot - begin)];
      begin = dot + 1;
    }
    (*parent)[path.substr(begin)] = from_text(value);
  }
  return result;
}

Json& Json::operator[](const std::string& name) {
  if (kind_ == Kind::kLiteral && text_ == "null") *this = object();
  FOOTHOLD_EXPECTS(kind_ == Kind::kObject);
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found != names_.end()) return items_[static_cast<std::size_t>(found - names_.begin())];
  names_.push_back(name);
  return items_.emplace_back();
}

void Json::update(const Json& other) {
  for (std::size_t i = 0; i < other.items_.size(); ++i) (*this)[other.names_[i]] = other.items_[i];
}

void Json::erase(const std::string& name) {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) return;
  items_.erase(items_.begin() + (found - names_.begin()));
  names_.erase(found);
}

void Json::push_back(Json item) {
  if (kind_ == Kind::kLiteral && text_ == "null") *this = array();
  FOOTHOLD_EXPECTS(kind_ == Kind::kArray);
  items_.push_back(std::move(item));
}

std::string Json::dump() const {
  std::string out;
  write(0, out);
  return out;
}

void Json::write(int depth, std::string& out) const {
  if (kind_ == Kind::kLiteral) {
    out += text_;
  } else if (kind_ == Kind::kText) {
    out += literal(text_);
  } else {
    const bool is_object = kind_ == Kind::kObject;
    const std::string indent = "\n" + std::string(static_cast<std::size_t>(2 * depth), ' ');
    out += is_object ? '{' : '[';
    for (std::size_t i = 0; i < items_.size(); ++i) {
      out += (i == 0 ? "" : ",") + indent + "  ";
      if (is_object) out += literal(names_[i]) + ": ";
      items_[i].write(depth + 1, out);
    }
    if (!items_.empty()) out += indent;
    out += is_object ? '}' : ']';
  }
}

}  // namespace foothold::apps
