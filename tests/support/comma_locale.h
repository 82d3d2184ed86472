// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A host that writes numbers as in Germany: 1.234,5.
#pragma once

#include <locale>
#include <string>

namespace foothold::test {

/// Makes a locale with decimal commas and grouped thousands that of C's functions and of C++'s new streams, until the end of its scope.
class CommaLocale {
 public:
  CommaLocale();
  ~CommaLocale();
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

  /// Whether C's functions heed it: not where package locales is missing. A test then says so with WARN.
  bool reached_c() const { return reached_c_; }

 private:
  std::locale former_;
  std::string former_c_;
  bool reached_c_ = false;
};

}  // namespace foothold::test
