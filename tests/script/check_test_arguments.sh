#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_test_arguments.sh ROOT WORK
# What `rebound test` hands to ctest, and what it refuses: the script of ROOT, with programs that print their arguments in
# place of what it runs.
set -euo pipefail

root=$1
work=$2
rm -rf -- "$work"
mkdir -p -- "$work/cmake" "$work/bin"
cp -- "$root/rebound" "$root/CMakePresets.json" "$work"
cp -- "$root/cmake/system_packages.txt" "$work/cmake"
for program in cmake/install_packages.sh bin/cmake bin/ctest; do
    printf '#!/bin/sh\necho "%s $*" >>"%s/calls"\n' "${program##*/}" "$work" >"$work/$program"
    chmod +x -- "$work/$program"
done
PATH=$work/bin:$PATH
unset REBOUND_PRESET

failed=0
fail() {
    echo "rebound $1: $2" >&2
    failed=1
}

# call ARGUMENT...: sets status, output, errors and calls.
call() {
    rm -f -- "$work/calls"
    status=0
    output=$("$work/rebound" "$@" 2>"$work/errors") || status=$?
    errors=$(<"$work/errors")
    calls=
    if [[ -e $work/calls ]]; then calls=$(<"$work/calls"); fi
}

# runs EXPECTED ARGUMENT...: ctest gets the arguments EXPECTED, behind a build of all.
runs() {
    call "${@:2}"
    [[ $status -eq 0 ]] || fail "${*:2}" "exit code $status, 0 was expected: $errors"
    [[ $calls == *"--target all"*$'\n'"ctest $1" ]] ||
        fail "${*:2}" "ctest $1 was expected behind a build, not: $calls"
}

# refuses WORDS ARGUMENT...: one sentence with these words, exit code 2, and nothing is run.
refuses() {
    call "${@:2}"
    [[ $status -eq 2 ]] || fail "${*:2}" "exit code $status, 2 was expected"
    [[ $errors == "rebound: "*"$1"*"expected" && $errors != *$'\n'* ]] ||
        fail "${*:2}" "one sentence with $1 was expected, not: $errors"
    [[ -z $calls && -z $output ]] || fail "${*:2}" "nothing was to run, but: $calls$output"
}

runs '--preset release -j2' test
runs '--preset release -j2 -L unit -V' test -L unit -V
runs '--preset release -j2 -LE a|b -j4 --repeat until-fail:3' test -LE 'a|b' -j4 --repeat until-fail:3
runs '--preset release -j2 -R plan -C long' test --all -R plan
[[ $calls == *clang-tidy-14* ]] || fail 'test --all' "clang-tidy-14 was to be installed, but: $calls"
REBOUND_PRESET=asan runs '--preset asan -j2 -C long' test --all

refuses '"--al"' test --al
refuses '"unit"' test unit
refuses '"-C"' test -C long
refuses '"--preset=debug"' test --preset=debug
refuses 'test -R has no value' test -V -R
refuses 'test -L has no value' test -L ''
REBOUND_PRESET=fast refuses 'REBOUND_PRESET is "fast"' test

call test --help
[[ $status -eq 0 && $output == *--all* && -z $calls ]] || fail 'test --help' "help was expected, not: $output$calls"

exit "$failed"
