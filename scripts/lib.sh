# SPDX-License-Identifier: GPL-3.0-or-later
# Shared by the scripts here; sourced with the repository's root as the working directory.

# Installs the packages that are missing; asks for root's rights only then.
install_packages() {
  local missing=() package
  for package in "$@"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  local root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "run as root: apt-get install ${missing[*]}" >&2; return 1; }
    root=(sudo)
  fi
  echo "== installing ${missing[*]}"
  "${root[@]}" apt-get -q update
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q install -y --no-install-recommends "${missing[@]}"
}

build_packages=(g++ cmake ninja-build dpkg-dev libeigen3-dev libspectra-dev libnanoflann-dev libcli11-dev
                nlohmann-json3-dev meshlab qtbase5-dev libqt5opengl5-dev libglew-dev)
# What the plugin for another MeshLab takes: that one brings its own vcglib and common library.
plugin_packages=(g++ cmake ninja-build libeigen3-dev libnanoflann-dev qtbase5-dev libqt5opengl5-dev libglew-dev)
screen_packages=(xvfb xauth)
picture_packages=(xdotool imagemagick)
# What makes the page of `ga_symmetry compare`, and the API reference.
page_packages=(python3-jinja2 python3-matplotlib)
docs_packages=(doxygen)
test_packages=(libgtest-dev lintian parallel valgrind "${page_packages[@]}" "${docs_packages[@]}")

# configure PRESET [OPTION]...: fetches MeshLab's source if need be, configures build/PRESET.
configure() {
  local preset=$1 source options=("${@:2}")
  case $preset in dev | release) options+=(-DGA_SYMMETRY_PLUGIN=ON) ;; esac
  source=$(scripts/get_meshlab_source)
  echo "== MeshLab's source is in $source"
  cmake --preset "$preset" --log-level=WARNING "${options[@]}" >/dev/null
}

# build PRESET [OPTION]... [-- TARGET...]: configures, then builds in build/PRESET.
build() {
  local preset=$1 options=() targets=()
  shift
  while [ $# -gt 0 ] && [ "$1" != -- ]; do options+=("$1") && shift; done
  [ $# -eq 0 ] || targets=(--target "${@:2}")
  configure "$preset" "${options[@]}"
  echo "== building in build/$preset"
  cmake --build "build/$preset" "${targets[@]}"
}

# What it takes to run the filter in MeshLab and to measure it.
build_release() {
  install_packages "${build_packages[@]}"
  build release -DBUILD_TESTING=OFF -- filter_ga_symmetry make_filter_script ga_symmetry_tool
}
