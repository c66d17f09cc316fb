# A package of Debian, made of what `cmake --install` installs.
deb() {  # FOLDER
  local folder=$1 log=$workspace/deb.log
  build_workspace
  with_progress "packing" "$log" built_percent pack "$folder" || fail "the package could not be made; $log says why."
  say "the package is in $(tail -n 1 "$log"); \"sudo apt install $(tail -n 1 "$log")\" installs it, and \"navvi run\" starts a session."
}

pack() {  # FOLDER
  local tree=$workspace/build/deb version depends recommends qt
  rm -rf "$tree" && mkdir -p "$tree/DEBIAN" || return
  DESTDIR=$tree cmake --install "$workspace/build" --prefix /usr --strip || return
  # Programs alone: no headers, nothing that finds a workspace, no Lisp.
  find "$tree" -mindepth 1 -maxdepth 1 ! -name usr ! -name DEBIAN -exec rm -r {} +
  find "$tree/usr" -maxdepth 1 -type f -delete
  rm -rf "$tree"/usr/{include,lib/pkgconfig,share/common-lisp} "$tree"/usr/share/*/cmake
  version=$(sed -n 's/.*<version>\(.*\)<.*/\1/p' "$workspace/src/navvi/package.xml")
  read -ra qt < <(qt_packages) || return
  depends=$(linked_to "$tree" ! -name '*navvi_rviz*') || return
  recommends=$(linked_to "$tree" -name '*navvi_rviz*') || return
  depends+=$(printf ', %s' python3 "${run_packages[@]}")
  recommends+=$(printf ', %s' "${comfort_packages[@]}" "${qt[@]}")
  control_files "$tree" "$version" "$depends" "$recommends"
  documents "$tree" "$version" || return
  # Of everybody's to read, and of nobody's to write.
  chmod -R u+rwX,go+rX,go-w "$tree"
  dpkg-deb --root-owner-group --build "$tree" "$1" >&2 && echo "$1/navvi_${version}_$(dpkg --print-architecture).deb"
}

# The packages of the libraries that programs are linked to.
linked_to() {  # TREE TEST-OF-FIND...
  local programs own tree=$1
  readarray -t programs < <(find "$tree/usr/lib" -type f \( -perm /u+x -o -name '*.so' \) "${@:2}" -exec grep -LI . {} +)
  mkdir -p "$tree/debian" && printf 'Source: navvi\n\nPackage: navvi\nArchitecture: any\n' >"$tree/debian/control"
  own=$(cd "$tree" && dpkg-shlibdeps -O --ignore-missing-info "-l$tree/usr/lib" "${programs[@]}" 2>&2) || return
  rm -r "$tree/debian"
  echo "${own#*=}"
}

control_files() {  # TREE VERSION DEPENDS RECOMMENDS
  cat >"$1/DEBIAN/control" <<T
Package: navvi
Version: $2
Architecture: $(dpkg --print-architecture)
Maintainer: NavVI developers <navvi@example.org>
Installed-Size: $(du -sk "$1/usr" | cut -f1)
Depends: $3
Recommends: $4
Section: science
Priority: optional
Description: drive a robot through a warehouse by touch, sound and what sight there is
 A warehouse in simulation in which a blind or low-vision person drives a
 mobile robot with one stick, feels obstacles through the pad and hears where
 to turn, and in which a researcher runs repeatable trials.
T
  echo "activate-noawait ldconfig" >"$1/DEBIAN/triggers"
  cat >"$1/DEBIAN/postinst" <<'T'
#!/bin/sh
set -e
[ "$1" != configure ] || py3compile -p navvi
T
  cat >"$1/DEBIAN/prerm" <<'T'
#!/bin/sh
set -e
py3clean -p navvi
T
  chmod 755 "$1"/DEBIAN/{postinst,prerm}
}

# What every package of Debian has, the manual, and who may read a pad.
documents() {  # TREE VERSION
  local doc=$1/usr/share/doc/navvi man=$1/usr/share/man/man1 rules=$1/usr/lib/udev/rules.d limits=$1/etc/security/limits.d
  mkdir -p "$doc" "$man" "$rules" "$limits"
  # The nodes that a person waits for may run before other programs.
  echo "@audio - nice -10" >"$limits/navvi.conf"
  echo /etc/security/limits.d/navvi.conf >"$1/DEBIAN/conffiles"
  { echo "NavVI"; echo; cat "$root/LICENSE"; } >"$doc/copyright"
  printf 'navvi (%s) unstable; urgency=medium\n\n  * CHANGELOG.md in the sources tells the changes.\n\n -- NavVI developers <navvi@example.org>  %s\n' "$2" "$(date -R)" |
    gzip -9n >"$doc/changelog.gz"
  "$1/usr/bin/navvi" man --write "$man/navvi.1" && gzip -9n "$man/navvi.1" || return
  find "$1" -name __pycache__ -prune -exec rm -r {} +
  cat >"$rules/60-navvi-pads.rules" <<'T'
# Whoever sits at the machine may feel and light the pads that speak over hidraw: those of Sony and of Nintendo.
KERNEL=="hidraw*", KERNELS=="*054C:*", TAG+="uaccess"
KERNEL=="hidraw*", KERNELS=="*057E:*", TAG+="uaccess"
T
}
