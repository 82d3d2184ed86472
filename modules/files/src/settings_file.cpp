// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/files/settings_file.h"

#include <nlohmann/json.hpp>
#include <set>

#include "foothold/base/atomic_file.h"
#include "foothold/base/input_file.h"
#include "foothold/base/printable.h"
#include "settings_json.h"

namespace foothold {
namespace files {
namespace {

using Json = nlohmann::ordered_json;

// Every level repeats the path to it.
constexpr std::size_t kMaxLevels = 32;
constexpr std::size_t kMaxPathCharacters = 1000;

/// Collects the leaves of a JSON object as a parser meets them, with their text as written, so that large integers keep every digit.
class LeafCollector : public nlohmann::json_sax<Json> {
 public:
  explicit LeafCollector(const std::string& file) : file_(file) {}
  std::vector<SettingText>& leaves() { return leaves_; }

  bool null() override { refuse("null"); }
  bool boolean(bool value) override { return leaf(value ? "true" : "false"); }
  bool number_integer(number_integer_t value) override { return leaf(std::to_string(value)); }
  bool number_unsigned(number_unsigned_t value) override { return leaf(std::to_string(value)); }
  bool number_float(number_float_t, const string_t& text) override { return leaf(text); }
  bool string(string_t& value) override { return leaf(value); }
  bool binary(binary_t&) override { refuse("binary data"); }
  bool start_array(std::size_t) override { refuse("a list"); }
  bool end_array() override { return true; }

  bool start_object(std::size_t) override {
    is_object_ = true;
    if (prefixes_.size() == kMaxLevels) refuse("objects in objects, " + std::to_string(kMaxLevels + 1) + " deep");
    prefixes_.push_back(prefixes_.empty() ? "" : path_ + ".");
    return true;
  }
  bool end_object() override {
    prefixes_.pop_back();
    return true;
  }
  bool key(string_t& name) override {
    path_ = prefixes_.back() + name;
    if (path_.size() > kMaxPathCharacters) refuse("a name of " + std::to_string(path_.size()) + " characters");
    if (!paths_.insert(path_).second) throw InvalidSettings(file_ + ": setting " + in_quotes(path_) + " is given twice");
    return true;
  }
  bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception&) override {
    throw_file_error(file_, "no JSON at byte " + std::to_string(position) + " near " + in_quotes(token), "a JSON object of settings");
  }

 private:
  bool leaf(std::string text) {
    if (!is_object_) refuse("a bare value");
    leaves_.push_back({path_, std::move(text)});
    return true;
  }
  [[noreturn]] void refuse(const std::string& what) const {
    if (!is_object_) throw_file_error(file_, what, "a JSON object of settings");
    throw InvalidSettings(file_ + ": setting " + in_quotes(path_) + ": got " + what +
                          ", expected a number, true, false, text or an object");
  }

  const std::string& file_;
  std::vector<SettingText> leaves_;
  std::vector<std::string> prefixes_;
  std::set<std::string> paths_;
  std::string path_;
  bool is_object_ = false;
};

}  // namespace

std::vector<SettingText> parse_settings_json(const std::string& text, const std::string& file) {
  LeafCollector collector(file);
  Json::sax_parse(text, &collector);
  return std::move(collector.leaves());
}

}  // namespace files

std::vector<SettingText> read_settings_file(const std::string& path) {
  constexpr std::size_t kMaxSettingsBytes = 16U << 20U;
  return files::parse_settings_json(read_file(path, kMaxSettingsBytes), path);
}

std::string settings_to_json(const std::vector<SettingDescription>& settings) {
  files::Json root = files::Json::object();
  for (const SettingDescription& setting : settings) {
    files::Json* node = &root;
    std::size_t begin = 0;
    for (std::size_t dot = setting.path.find('.'); dot != std::string::npos; dot = setting.path.find('.', begin)) {
      node = &(*node)[setting.path.substr(begin, dot - begin)];
      begin = dot + 1;
    }
    const bool is_text = setting.range.empty();
    (*node)[setting.path.substr(begin)] = is_text ? files::Json(setting.value) : files::Json::parse(setting.value);
  }
  return root.dump(2) + "\n";
}

void write_settings_text(const std::string& path, const std::string& text) { write_file_atomically(path, text); }

}  // namespace foothold
