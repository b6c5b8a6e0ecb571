#!/bin/sh
# Ctrl-C ends examples/progress.c with a message and nothing else: interrupt.sh PROGRAM
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# A rough square of 160,000 vertices: seconds of work.
awk 'BEGIN {
    n = 400
    print "OFF"; print n * n, 2 * (n - 1) * (n - 1), 0
    for (v = 0; v < n * n; v++) print v % n, int(v / n), rand()
    for (y = 1; y < n; y++) for (x = 1; x < n; x++) { v = y * n + x; print 3, v - n - 1, v - n, v; print 3, v - n - 1, v, v - 1 }
}' > "$folder/rough.off"
"$1" "$folder/rough.off" 0 > "$folder/out" 2> "$folder/err" &
program=$!
until grep -qs % "$folder/err"; do sleep 0.01; done
kill -INT $program
status=0
wait $program || status=$?
tr '\r' '\n' < "$folder/err" | tail -n 2
[ $status -eq 130 ] && [ ! -s "$folder/out" ] && grep -q 'the work was cancelled' "$folder/err"
