#!/bin/bash
# A program that breaks at an empty word: what odd_commands.py must find.
[ "$1" = config ] && { [ $# = 1 ] && echo "body:" && echo "  radius: 0.3" && exit 0; echo "robot.yaml:1: odd"; exit 1; }
if [ "$1" = --help ]; then echo "  drive                       Drives"; exit 0; fi
if [ "$2" = --help ]; then echo "  --speed FLOAT               of it"; exit 0; fi
for word in "$@"; do [ -z "$word" ] && kill -ABRT $$; done
[ $# -lt 2 ] || { echo "no"; exit 1; }
