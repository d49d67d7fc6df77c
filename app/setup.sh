# Sourced by app/run and tests/run: installs the Debian packages that building and running need, where they are missing.
# Uses sudo when not root. Works on Debian 12 with nothing but git.

fb_packages="build-essential cmake ninja-build ccache pkg-config git
 libglfw3-dev libglm-dev libimgui-dev libstb-dev libopenimageio-dev libopenmesh-dev libepoxy-dev libegl-dev libgl-dev
 libmeshoptimizer-dev libtinyobjloader-dev libtinygltf-dev libtbb-dev libtomlplusplus-dev nlohmann-json3-dev
 libopenmpi-dev openmpi-bin libcli11-dev libxxhash-dev libexpected-dev libgl1-mesa-dri libegl-mesa0 libegl1 fonts-dejavu-core"
fb_test_packages="libgtest-dev libbenchmark-dev librapidcheck-dev xvfb xdotool xauth strace"

fb_install() {
    missing=""
    for package in "$@"; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing="$missing $package"
    done
    [ -z "$missing" ] && return 0
    as_root=""
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || { echo "these packages are missing and sudo is not there:$missing" >&2; return 1; }
        as_root=sudo
    fi
    echo "installing:$missing" >&2
    $as_root apt-get update -qq
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >&2
}
