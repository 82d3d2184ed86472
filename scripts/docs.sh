#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Writes the API reference of all public headers with Doxygen. Its warnings are errors.
#
#   scripts/docs.sh [FOLDER]
#
# FOLDER (default: build/docs) receives html/index.html. Exits with 77 (CTest: skipped) where Doxygen is absent.
set -euo pipefail
folder=$(realpath -m "${1:-$(dirname "$0")/../build/docs}")
cd "$(dirname "$0")/.."

if ! command -v doxygen >/dev/null; then
  echo "docs: Doxygen is not installed; scripts/install_packages.sh --developer installs it" >&2
  exit 77
fi

rm -rf "$folder/html"
mkdir -p "$folder"
includes=$(echo modules/*/include)
doxygen - <<END
$(cat docs/Doxyfile)
INPUT                  = docs/conventions.md $includes
RECURSIVE              = YES
STRIP_FROM_PATH        = $(echo modules/*/include/foothold)
STRIP_FROM_INC_PATH    = $includes
OUTPUT_DIRECTORY       = "$folder"
WARN_LOGFILE           = "$folder/warnings.txt"
END

if [[ -s $folder/warnings.txt ]]; then
  cat "$folder/warnings.txt" >&2
  echo "docs: Doxygen's warnings are errors" >&2
  exit 1
fi
echo "docs: $folder/html/index.html"
