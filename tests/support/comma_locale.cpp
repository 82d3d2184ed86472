// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "support/comma_locale.h"

#include <clocale>
#include <cstdlib>

namespace foothold::test {
namespace {

struct CommaNumbers : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

}  // namespace

CommaLocale::CommaLocale() : former_c_(std::setlocale(LC_ALL, nullptr)) {
  former_ = std::locale::global(std::locale(std::locale::classic(), new CommaNumbers));  // which owns it
  ::setenv("LOCPATH", FOOTHOLD_TEST_LOCALES, 1);
  reached_c_ = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr && *std::localeconv()->decimal_point == ',';
}

CommaLocale::~CommaLocale() {
  std::setlocale(LC_ALL, former_c_.c_str());
  ::unsetenv("LOCPATH");
  std::locale::global(former_);
}

}  // namespace foothold::test
