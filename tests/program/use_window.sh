#!/usr/bin/env bash
# use_window.sh PROGRAM SCENE FOLDER: opens the real window on a display of its own, flies, tunes c_targetTime down by
# clicking its slider, hides and shows the panels, saves pictures, quits. FOLDER then holds out/ (the session's report),
# frontbench-1.png (panels), frontbench-2.png (the view alone), frontbench-3.png (after tuning) and errors.
set -euo pipefail
program=$1 scene=$2 folder=$3
cd "$folder"

Xvfb -displayfd 3 -screen 0 1280x800x24 -nolisten tcp -noreset 3>display 2>/dev/null &
server=$!
trap 'kill $server 2>/dev/null || true' EXIT
for _ in $(seq 100); do [ -s display ] && break; sleep 0.1; done
export DISPLAY=":$(cat display)"

"$program" "$scene" --size 1280x800 --set control.target_ms=600 --out out 2>errors &
window=$!
timeout 60 xdotool search --sync --onlyvisible --name Frontbench >/dev/null
sleep 2

xdotool mousemove 300 200 sleep 0.2 keydown w sleep 1 keyup w
xdotool mousedown 3
for _ in $(seq 20); do xdotool mousemove_relative 6 0 sleep 0.02; done
xdotool mouseup 3 sleep 2 key F12 sleep 0.5
xdotool key Tab sleep 0.5 key F12 sleep 0.5 key Tab sleep 0.5
# The search leaves one knob below its group's header; the left end of its slider is 1.5 ms.
xdotool mousemove 1000 36 click 1 sleep 0.3 type target_ms
xdotool sleep 0.5 mousemove 908 86 sleep 0.2 mousedown 1 sleep 0.3 mouseup 1
# Away from the text, whose keys would be typed into it.
xdotool sleep 3 mousemove 300 60 click 1 sleep 0.3 key F12 sleep 0.5 key ctrl+q
for _ in $(seq 100); do kill -0 $window 2>/dev/null || break; sleep 0.1; done
kill $window 2>/dev/null || true
wait $window || { code=$?; echo "the window ended with $code:" >&2; cat errors >&2; exit $code; }
