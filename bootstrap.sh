#!/usr/bin/env bash
# Installs what is missing, builds ElVis into build/release, and then either draws a picture or runs the tests.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

# Debian 12 packages. Tools, then libraries, then what the Python package, elvis-mpi, the plugin for ParaView and the tests use.
packages=(
    cmake ninja-build g++ pkg-config
    libvulkan-dev mesa-vulkan-drivers glslang-dev glslang-tools spirv-tools
    libboost-dev libeigen3-dev libhdf5-dev libspdlog-dev libfmt-dev libcli11-dev nlohmann-json3-dev libpng-dev
    libfreetype-dev fonts-dejavu-core libglfw3-dev libimgui-dev libstb-dev
    libpugixml-dev zlib1g-dev libdeflate-dev liblz4-dev libturbojpeg0-dev node-typescript
)
python_packages=(python3-dev pybind11-dev python3-numpy)
mpi_packages=(libopenmpi-dev openmpi-bin)
paraview_packages=(paraview-dev python3-paraview libglew-dev)
test_packages=(catch2 clang-format mkdocs vulkan-validationlayers python3-h5py python3-matplotlib gmsh libcgns-dev xvfb xdotool imagemagick abigail-tools
    chromium chromium-driver nginx-light gfortran hdf5-tools metis)

usage() {
    cat <<'END'
usage: ./bootstrap.sh demo    install, build, draw the flow past a canister to elvis-demo.png
       ./bootstrap.sh test    install, build, run all tests
       ./bootstrap.sh build   install, build
       ./bootstrap.sh install [PREFIX]   install, build, then put program, library and Python package below PREFIX
                              (by default /usr/local as root, else ~/.local)
END
}

install_missing() {
    local wanted=("$@") missing=() package
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        echo "This is not a Debian system. ElVis needs what these Debian 12 packages hold:" >&2
        printf '  %s\n' "${wanted[@]}" >&2
        echo "Install them, then run: cmake --preset release && cmake --build --preset release" >&2
        exit 1
    fi
    for package in "${wanted[@]}"; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
    done
    if [ ${#missing[@]} -eq 0 ]; then
        return
    fi
    echo "Installing: ${missing[*]}"
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || { echo "Installing needs root or sudo. Ask for: apt-get install ${missing[*]}" >&2; exit 1; }
        as_root=(sudo)
    fi
    "${as_root[@]}" apt-get update
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"
}

build() { # arguments: further cmake options
    cmake --preset release -DELVIS_COMPILE_TOGETHER=ON "$@"
    cmake --build --preset release
}

demo() {
    local elvis=build/release/bin/elvis
    "$elvis" convert tests/data/elvis/bulletH1P2.dat -o elvis-demo.h5
    "$elvis" render tests/data/demo_scene.json -o elvis-demo.png
    echo "The picture is in elvis-demo.png, its volume in elvis-demo.h5."
}

# Python finds the package by itself below /usr/local and ~/.local; elsewhere a file in the user's folder leads to it.
install_below() {
    local prefix=$1 packages=dist-packages version
    version=$(/usr/bin/python3 -c 'import sys; print("%d.%d" % sys.version_info[:2])')
    case "$prefix" in /usr | /usr/local) ;; *) packages=site-packages ;; esac
    build -DELVIS_BUILD_TESTS=OFF -DELVIS_PYTHON_DIRECTORY="lib/python$version/$packages"
    cmake --install build/release --prefix "$prefix"
    local folder="$prefix/lib/python$version/$packages" found='import elvis; print(elvis.__path__[0])' user
    if [ "$(cd / && /usr/bin/python3 -c "$found" 2>/dev/null)" != "$folder/elvis" ]; then
        user=$(/usr/bin/python3 -m site --user-site)
        mkdir -p "$user"
        echo "$folder" >"$user/elvis.pth"
    fi
    echo "Python has the package elvis in $(cd / && /usr/bin/python3 -c "$found")."
    echo "The program is $prefix/bin/elvis."
}

case "${1:-}" in
demo)
    install_missing "${packages[@]}"
    build -DELVIS_BUILD_TESTS=OFF
    demo
    ;;
test)
    install_missing "${packages[@]}" "${python_packages[@]}" "${mpi_packages[@]}" "${paraview_packages[@]}" "${test_packages[@]}"
    build -DELVIS_BUILD_TESTS=ON
    ctest --preset release --parallel "$(nproc)"
    ;;
build)
    install_missing "${packages[@]}" "${python_packages[@]}" "${mpi_packages[@]}" "${paraview_packages[@]}" "${test_packages[@]}"
    build -DELVIS_BUILD_TESTS=ON
    ;;
install)
    install_missing "${packages[@]}" "${python_packages[@]}" "${mpi_packages[@]}"
    prefix=${2:-$([ "$(id -u)" -eq 0 ] && echo /usr/local || echo "$HOME/.local")}
    install_below "$(realpath -m "$prefix")"
    ;;
*)
    usage >&2
    exit 2
    ;;
esac
