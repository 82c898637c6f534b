#!/usr/bin/env bash
# The Debian packages: what lies in them, what they ask for, what lintian and the checkers of desktops say, and
# that the program works from where they put it.
#   tests/scripts/packages_test.sh BUILD_FOLDER
# Exit code 77: skipped, as the tools of Debian's packages are not here, or the build has not all programs.
set -euo pipefail
shopt -s extglob
build=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

fail() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}
skip() {
    echo "skipped: $*"
    exit 77
}
command -v dpkg-shlibdeps >/dev/null || skip "dpkg-shlibdeps is not here (package dpkg-dev)"
for program in raks raks-train raks-capture raks-soundfont; do
    [ -x "$build/bin/$program" ] || skip "$program was not built"
done

# Compressing takes longest: by gzip they are the same packages.
(cd "$build" && cpack -G DEB -B "$work/packages" -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip) >"$work/log" 2>&1 ||
    { cat "$work/log"; fail "cpack"; exit 1; }
cd "$work"
version=$("$build/bin/raks" --version | sed -n 's/^raks //p')
for name in raks raks-train raks-capture; do
    [ -e "packages/${name}_${version}_amd64.deb" ] || fail "there is no ${name}_${version}_amd64.deb"
    dpkg-deb -x "packages/${name}_${version}_amd64.deb" "$name"
done
# The same programs give the same bytes, at another time and in another folder.
(cd "$build" && cpack -G DEB -B "$work/again" -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip \
    -D CPACK_COMPONENTS_ALL=train) >"$work/log" 2>&1 || fail "cpack: $(cat "$work/log")"
cmp {packages,again}/"raks-train_${version}_amd64.deb" || fail "the same package has other bytes"

field() { dpkg-deb -f "packages/$1_${version}_amd64.deb" "$2"; }

# holds PACKAGE FILE...: the files lie in it.
holds() {
    local package=$1 file
    shift
    for file in "$@"; do
        [ -e "$package/usr/$file" ] || fail "$package: $file is missing"
    done
}
holds raks bin/raks libexec/raks/raks-{decode,import,unpack} lib/raks/raks-{film,codec}.so \
    share/raks/models/trained/dances.toml share/raks/config/default.toml share/raks/config/themes/{stage,club,dance_floor}.toml \
    share/applications/org.raks.Raks.desktop share/metainfo/org.raks.Raks.metainfo.xml \
    share/mime/packages/org.raks.Raks.xml share/icons/hicolor/scalable/apps/org.raks.Raks.svg \
    share/man/man1/raks{,-play,-live,-xbody}.1.gz share/bash-completion/completions/raks \
    share/zsh/vendor-completions/_raks share/fish/vendor_completions.d/raks.fish \
    share/icons/hicolor/{48x48,64x64,128x128,256x256,512x512}/apps/org.raks.Raks.png
holds raks-train bin/raks-train share/man/man1/raks-train.1.gz libexec/raks/raks-soundfont
holds raks-capture bin/raks-capture share/man/man1/raks-capture.1.gz
for name in raks raks-train raks-capture; do
    grep -q 'GNU General$' "$name/usr/share/doc/$name/copyright" || fail "$name: the copyright does not name the GPL"
done

# Dancing brings along neither what learns nor what captures; PipeWire is no more than recommended.
[[ "$(field raks Depends)" != *@(openblas|fluidsynth|opencv|ceres|libpipewire)* ]] ||
    fail "raks depends on $(field raks Depends)"
if [ -e raks/usr/lib/raks/raks-pipewire.so ]; then
    [[ "$(field raks Recommends)" == libpipewire-0.3-0* ]] || fail "raks recommends $(field raks Recommends)"
fi
for name in raks-train raks-capture; do
    [[ "$(field $name Depends)" == *"raks (= $version)"* ]] || fail "$name does not ask for raks of its build"
done

# Where it was built is in no file, and no program looks for libraries in places of its own.
source=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt")
while IFS= read -r file; do
    found=$(strings -a "$file" | grep -F -m 1 -e "$source" -e "$build" || true)
    [ -z "$found" ] || fail "$file: has the path $found"
    [[ "$(readelf -d "$file" 2>/dev/null)" != *@(RPATH|RUNPATH)* ]] || fail "$file: has an RPATH"
done < <(find raks raks-train raks-capture -type f)

# From the place where it is unpacked, with nothing of the build: it dances, and names the packages that
# are not there.
unset RAKS_DATA
raks/usr/bin/raks dances >/dev/null || fail "raks dances"
for name in train capture; do
    code=0
    said=$(raks/usr/bin/raks $name --help 2>&1) || fail "raks $name --help: $said"
    first=$(sed -n '/^Subcommands:/{n;s/^ *\([a-z]*\).*/\1/p}' <<<"$said")
    said=$(raks/usr/bin/raks $name "$first" 2>&1) || code=$?
    [ $code -eq 1 ] && [[ "$said" == *"install the package raks-$name" ]] || fail "raks $name $first: $code, $said"
done

# checked TOOL COMMAND...: the command says nothing and ends with 0.
checked() {
    local tool=$1 said
    shift
    command -v "$tool" >/dev/null || { echo "skipped: $tool is not here"; return; }
    said=$("$@" 2>&1) || said="it ends with $?: $said"
    [ -z "$said" ] || fail "$tool: $said"
}
checked desktop-file-validate desktop-file-validate raks/usr/share/applications/org.raks.Raks.desktop
checked lintian lintian --allow-root --fail-on warning packages/*.deb
if command -v appstreamcli >/dev/null; then
    appstreamcli validate --no-net raks/usr/share/metainfo/*.xml >"$work/appstream" ||
        fail "appstreamcli: $(cat "$work/appstream")"
else
    echo "skipped: appstreamcli is not here"
fi
if command -v flatpak-builder >/dev/null; then
    flatpak-builder --show-manifest "$source/packaging/flatpak/org.raks.Raks.yml" >"$work/log" 2>&1 ||
        fail "flatpak-builder: $(cat "$work/log")"
else
    echo "skipped: flatpak-builder is not here"
fi

# The types of files that its entry opens: .vrm is no VRML, which shared-mime-info takes it for.
if command -v update-mime-database >/dev/null && command -v gio >/dev/null; then
    mkdir -p data/mime/packages
    cp /usr/share/mime/packages/freedesktop.org.xml raks/usr/share/mime/packages/*.xml data/mime/packages
    update-mime-database data/mime 2>"$work/log" || fail "update-mime-database: $(cat "$work/log")"
    printf 'glTF\2\0\0\0' | tee a.vrm >a.vrma
    for ending in vrm vrma; do
        said=$(XDG_DATA_HOME=$work/none XDG_DATA_DIRS=$work/data gio info -a standard::content-type "a.$ending")
        [[ "$said" == *" model/$ending" ]] || fail "a.$ending: $said"
    done
else
    echo "skipped: update-mime-database or gio is not here"
fi
exit $((failures > 0))
