# SPDX-License-Identifier: GPL-3.0-or-later
# MeshLab's window on a virtual screen of 1280 x 900, used with the mouse and the keyboard as a person does. Sourced, with
# in program  the MeshLab to start,
# in settings an empty folder: its settings, and its log in the file log,
# in out      the folder of the pictures of `shot`.

export XDG_CONFIG_HOME=$settings
for name in MeshLab_64bit_fp MeshLab_64bit_dp; do  # MeshLab 2025 would ask at its first start
  mkdir -p "$settings/VCG"
  printf '[General]\ninformativeShown=true\n' > "$settings/VCG/$name.conf"
done
meshlab=

stop_window() {
  [ -z "$meshlab" ] || { kill "$meshlab" && wait "$meshlab" 2> /dev/null || true; }
  meshlab=
}

# start MESH...: the window with these layers
start() {
  stop_window
  "$program" "$@" > "$settings/log" 2>&1 &
  meshlab=$!
  for _ in $(seq 120); do
    ! grep -q "All files opened" "$settings/log" || break
    sleep 0.5
  done
  window=$(xdotool search --sync --onlyvisible --name 'MeshLab.*Project' | head -n1)
  sleep 2
  xdotool windowmove "$window" 0 0 windowsize "$window" 1280 900
  sleep 1.5
  xdotool windowfocus "$window" mousemove 500 700 click 1
  sleep 1
}

# shot NAME [GEOMETRY]: a part of the screen, as a small PNG
shot() {
  import -silent -window root "$settings/shot.png"
  convert "$settings/shot.png" ${2:+-crop "$2" +repage} -colors 200 "png8:$out/$1.png"
}

# filter NAME [PICTURE]: opens the filter's dialog by the search box
filter() {
  xdotool windowfocus "$window" key ctrl+f
  sleep 0.5
  xdotool type "Intrinsic Symmetry: $1"
  sleep 1.5
  xdotool mousemove 918 100 click 1
  sleep 1.5
  dialog=$(xdotool search --sync --onlyvisible --name "^Intrinsic Symmetry: $1" | head -n1)
  xdotool windowmove "$dialog" 0 0
  sleep 0.5
  eval "$(xdotool getwindowgeometry --shell "$dialog")"
  width=$WIDTH height=$HEIGHT
  [ -z "${2:-}" ] || shot "$2" "${width}x$height+0+0"
}

# apply: presses Apply and waits until the filter has ended
apply() {
  local before
  before=$(finished)
  xdotool mousemove $((width - 108)) $((height - 22)) click 1
  for _ in $(seq 240); do
    [ "$(finished)" = "$before" ] || break
    sleep 0.5
  done
  sleep 3
}
finished() { grep -Ec "Applied filter|select four" "$settings/log" || true; }

# close: presses Close
close() {
  xdotool mousemove $((108)) $((height - 22)) click 1
  sleep 1.5
}

# choose_file X Y FILE: presses the button of a file's parameter; a path that is typed into the field is not taken
choose_file() {
  xdotool mousemove "$1" "$2" click 1
  sleep 2
  xdotool type "$3"
  xdotool key Return
  sleep 1.5
}
