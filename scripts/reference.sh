#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The reference of the libraries, by Doxygen from their public headers: build/reference/html/index.html.
# Fails on any warning.
set -euo pipefail
cd "$(dirname "$0")/.."
mkdir -p build/reference
doxygen docs/Doxyfile
echo "build/reference/html/index.html"
