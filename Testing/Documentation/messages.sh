#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Checks that Utilities/check-message.sh accepts good commit messages and refuses others: messages.sh SOURCE
set -eu
check=$1/Utilities/check-message.sh
file=$(mktemp)
trap 'rm -f "$file"' EXIT

accept() { # MESSAGE
  printf "$1" > "$file"
  sh "$check" "$file" || { echo "refused: $1"; exit 1; }
}
refuse() { # MESSAGE
  printf "$1" > "$file"
  ! sh "$check" "$file" 2> /dev/null || { echo "accepted: $1"; exit 1; }
}
accept 'A subject\n\nThe reason.\n'
accept 'A subject\n\nThe reason.\n# a comment of git\n'
accept "Merge branch 'x'\n"
refuse 'A subject\n'
refuse 'A subject\n\n# a comment is no reason\n'
refuse 'A subject\nThe reason without an empty line.\n'
refuse "$(printf '%073d' 1)"'\n\nThe reason.\n'
