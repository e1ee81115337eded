#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Checks a commit message: sh Utilities/check-message.sh FILE
# The subject has at most 72 characters, the second line is empty, and a body says why. Merges need no body.
set -eu

[ $# -eq 1 ] && [ -f "$1" ] || {
  sed -n '3,4s/^# \{0,1\}//p' "$0" >&2
  exit 2
}
exec awk '
  /^#/ { next }
  { lines[++count] = $0 }
  END {
    if (length(lines[1]) > 72) {
      print "The subject has " length(lines[1]) " characters; at most 72 are allowed." > "/dev/stderr"
      exit 1
    }
    if (lines[1] ~ /^Merge /) exit 0
    if (count > 1 && lines[2] != "") {
      print "The second line must be empty; it separates the subject from the body." > "/dev/stderr"
      exit 1
    }
    for (i = 3; i <= count; ++i) if (lines[i] ~ /[^ ]/) exit 0
    print "The message has no body; say why the change is made." > "/dev/stderr"
    exit 1
  }' "$1"
