#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds with strict warnings as errors, runs all tests.
# Arguments go to ctest: scripts/test.sh -R geometry
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_dependencies.sh --workflows
cmake --preset dev
cmake --build --preset dev --parallel "$(nproc)"
ctest --preset dev --parallel "$(nproc)" "$@"
