#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Formats every C++ and CUDA file with clang-format 14, as tests/checks demands.
set -euo pipefail
cd "$(dirname "$0")/.."
status=0
python3 tests/checks/format.py . --fix || status=$?
[[ $status -ne 77 ]] || exit 1
exit "$status"
