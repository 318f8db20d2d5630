#!/bin/bash
# The long form of the test BadInput: every offset of every file, every key, every kind of value.
set -euo pipefail
if [ "${1:-}" = --help ]; then
  echo "usage: tests/robustness/bad_input.sh [BUILD_FOLDER]"
  echo "Runs bad_input_test of a build (default: build/release) on all damages. Exit code 0: no finding."
  exit 0
fi
cd "$(dirname "$0")/../.."
program=$(find "${1:-build/release}" -name bad_input_test -type f -perm -u+x | head -1)
[ -n "$program" ] || { echo "bad_input_test is not built: cmake --build build/release --target bad_input_test"; exit 2; }
log=$(mktemp)
trap 'rm -f "$log"' EXIT
code=0
TELESTRAIN_ALL_DAMAGE=1 "$program" >"$log" 2>&1 || code=$?
grep -E "FAILED|Failure" "$log" | sort | uniq -c | head -40 || true
echo "$(grep -c '^\[       OK' "$log") of $(grep -c '^\[ RUN' "$log") groups without a finding, $(grep -c Failure "$log" || true) findings"
exit "$code"
