# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Sourced by scripts that take [PRESET] [-DOPTION=VALUE...] [OTHER...]: sorts their arguments into preset (as before if none is given),
# options and others.
if [[ $# -gt 0 && $1 != -* ]]; then
  preset=$1
  shift
fi
options=()
others=()
for argument in "$@"; do
  if [[ $argument == -D[A-Za-z_]*=* ]]; then
    options+=("$argument")
  else
    others+=("$argument")
  fi
done
