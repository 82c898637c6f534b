#!/usr/bin/env bash
# Makes the Debian packages of build/release, and tries them on an empty Debian 12: they install with what
# Debian itself has, an ordinary user without a home gets a film in two languages, they are installed twice
# and over an older version, and nothing of them stays behind.
#   scripts/package.sh            makes the packages, in build/packages
#   scripts/package.sh --try      tries raks as well: needs root, debootstrap and the network; some minutes
#   scripts/package.sh --try-all  also raks-train and raks-capture, which bring along some 500 MB
# Prints a line a step; exit code 1 when something is wrong.
set -euo pipefail
cd "$(dirname "$0")/.."

case "${1:-}" in
    ""|--try|--try-all) mode=${1:-} ;;
    *) echo "usage: scripts/package.sh [--try|--try-all]" >&2; exit 2 ;;
esac
say() { echo "package: $* ($SECONDS s)" >&2; }
give_up() {
    say "$*"
    exit 1
}

[ -x build/release/bin/raks ] || give_up "build/release/bin/raks is not there; scripts/build.sh builds it"
mkdir -p build
cpack --preset deb >build/package.log 2>&1 || give_up "the packages cannot be made: $(tail -n 1 build/package.log)"
version=$(dpkg-deb -f "$(ls -t build/packages/raks_*.deb | head -n 1)" Version)
say "made: $(cd build/packages && ls -- *_"$version"_*.deb | tr '\n' ' ')"
[ -n "$mode" ] || exit 0

[ "$(id -u)" -eq 0 ] || give_up "an empty system needs root: sudo scripts/package.sh $mode"
command -v debootstrap >/dev/null || give_up "debootstrap is not here (package debootstrap)"
root=$(mktemp -d -p build empty_debian.XXXXXX)
root=$PWD/$root
chmod 755 "$root"  # for the user in it
leave() {
    umount "$root/proc" 2>/dev/null || true
    rm -rf --one-file-system "$root"
}
trap leave EXIT

debootstrap --variant=minbase bookworm "$root" http://deb.debian.org/debian >build/package.log 2>&1 ||
    give_up "debootstrap: $(tail -n 1 build/package.log)"
mount -t proc proc "$root/proc"
say "an empty Debian 12: $(du -sm --one-file-system "$root" | cut -f 1) MB"

# inside COMMAND...: as root, in the empty system; what it prints goes to the log.
inside() {
    chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive "$@" \
        >>build/package.log 2>&1 </dev/null || give_up "$*: $(tail -n 1 build/package.log)"
}
# as_user COMMAND...: as somebody without a home, and without any variable but the language.
as_user() {
    chroot --userspec=1000:1000 "$root" env -i PATH=/usr/bin:/bin ${language:+LC_ALL=$language} \
        sh -c 'cd /tmp/user && exec "$@"' sh "$@" </dev/null
}
# Without what apt keeps for itself.
size() {
    inside apt-get clean
    du -sm --one-file-system "$root" | cut -f 1
}
installed() { chroot "$root" dpkg-query -W -f='${db:Status-Abbrev}${Package}\n' | grep -c '^ii'; }

inside apt-get -y install locales
inside localedef -i de_DE -f UTF-8 de_DE.UTF-8
inside useradd --no-create-home --uid 1000 user
install -d -o 1000 -g 1000 "$root/tmp/user"
mkdir "$root/packages"
cp build/packages/*_"$version"_*.deb "$root/packages"

# An older version, with a file that the new one has no more.
mkdir "$root/packages/old"
dpkg-deb -R "build/packages/raks_${version}_amd64.deb" "$root/packages/old"
sed -i "s/^Version: .*/Version: $version~old/" "$root/packages/old/DEBIAN/control"
touch "$root/packages/old/usr/share/raks/of_the_old_version"
dpkg-deb --root-owner-group -Znone -b "$root/packages/old" "$root/packages/old.deb" >>build/package.log

before=$(installed)
megabytes=$(size)
inside apt-get -y install /packages/old.deb
say "raks brings along $(($(installed) - before)) packages, $(($(size) - megabytes)) MB"
inside apt-get -y install "/packages/raks_${version}_amd64.deb"
inside apt-get -y install --reinstall "/packages/raks_${version}_amd64.deb"
[ ! -e "$root/usr/share/raks/of_the_old_version" ] || give_up "a file of the older version is still there"
[ "$(chroot "$root" dpkg-query -W -f='${Version}' raks)" = "$version" ] || give_up "the version is not $version"
say "installed over an older version, and once more"

# dances: what an ordinary person does first.
dances() {
    local said
    said=$(as_user raks --version) || give_up "raks --version ends with $?"
    [[ "$said" == *"FFmpeg    5"* && "$said" == *"licence   GPL"* ]] || give_up "raks --version: $said"
    said=$(as_user raks devices 2>&1) || give_up "raks devices ends with $?: $said"
    rm -f "$root/tmp/user/x.mp4"
    as_user raks render -o x.mp4 --duration 2 --size 640x360 2>>build/package.log ||
        give_up "raks render ends with $?: $(tail -n 1 build/package.log)"
    said=$(ffprobe -v error -show_entries format=duration:stream=codec_name,nb_frames -of csv "$root/tmp/user/x.mp4" |
        tr '\n' ' ')
    [[ "$said" == *h264,60*aac,*format,2.* ]] || give_up "the film is \"$said\""
    say "danced with LC_ALL=${language:-nothing}: $said"
}
for language in "" C de_DE.UTF-8; do dances; done
code=0
language=C said=$(as_user raks train figure 2>&1) || code=$?
[ $code -eq 1 ] && [[ "$said" == *"install the package raks-train" ]] || give_up "raks train: $code, $said"

if [ "$mode" = --try-all ]; then
    for package in raks-train raks-capture; do
        before=$(installed)
        megabytes=$(size)
        inside apt-get -y install "/packages/${package}_${version}_amd64.deb"
        said=$(as_user raks "${package#raks-}" --help) || give_up "$package: $said"
        said=$(as_user "$package" --help) || give_up "$package: $said"
        say "$package brings along $(($(installed) - before)) packages, $(($(size) - megabytes)) MB"
    done
    inside apt-get -y remove raks-train raks-capture
fi

inside apt-get -y remove raks
left=$(cd "$root" && find . -xdev -iname '*raks*' ! -path './tmp/*' ! -path './proc/*' ! -path './packages/*' || true)
[ -z "$left" ] || give_up "what stays behind: $left"
say "removed; nothing stays behind"
