#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Layout and common mistakes of all C++ in the repository.
#   cmake/check_style.sh                        layout, by clang-format
#   cmake/check_style.sh BUILD                  and mistakes, by clang-tidy: in sources that differ from origin/main, or
#                                               from the branch or commit in REBOUND_BASE
#   cmake/check_style.sh BUILD --all            in all sources
#   cmake/check_style.sh BUILD FILE...          in these
# BUILD: a build folder with compile_commands.json, such as build/release. Exit status 1: something was found.
set -euo pipefail

root=$(CDPATH='' cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
cd -- "$root"

# The version decides the layout.
clang-format-14 --version >/dev/null
git ls-files -z -- '*.hpp' '*.cpp' '*.h' '*.inl' | xargs -0 -n 32 -P "$(nproc)" clang-format-14 --dry-run -Werror || exit 1

[[ $# -gt 0 ]] || exit 0
build=$1
shift
if [[ ! -e $build/compile_commands.json ]]; then
    echo "check_style: $build has no compile_commands.json; a configured build folder was expected" >&2
    exit 2
fi
if [[ $# -eq 0 ]]; then
    mapfile -t files < <(git diff --name-only --diff-filter=d "${REBOUND_BASE:-origin/main}" -- '*.cpp')
elif [[ $1 == --all ]]; then
    mapfile -t files < <(git ls-files -- '*.cpp')
else
    files=("$@")
fi
# Those that the build compiles: its commands say how.
known=()
for file in "${files[@]}"; do
    if grep -qF "\"$root/$file\"" "$build/compile_commands.json"; then known+=("$file"); fi
done
echo "check_style: clang-tidy on ${#known[@]} of ${#files[@]} sources"
[[ ${#known[@]} -gt 0 ]] || exit 0
# Without headers that GCC has precompiled, which Clang cannot read: so each file is seen to include what it needs.
commands=$(mktemp -d)
trap 'rm -rf -- "$commands"' EXIT
sed -E 's/ -Winvalid-pch| -include [^ ]*cmake_pch\.hxx//g' "$build/compile_commands.json" >"$commands/compile_commands.json"
printf '%s\0' "${known[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy-14 --quiet \
    --extra-arg=-Wno-unknown-warning-option -p "$commands" 2>/dev/null || exit 1
