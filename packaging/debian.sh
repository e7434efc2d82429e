# shellcheck shell=bash
# Sourced by scripts that need a Debian 12 of their own, as root, with debootstrap.

# make_debian FOLDER: an empty one, whose packages come from the mirror, with the certificates and proxies, of this
# machine.
make_debian() {
  local mirror
  mirror=$(grep -rhE '^URIs:.*debian/?$' /etc/apt/sources.list.d/ | head -n 1 | sed 's/URIs: *//') || true
  debootstrap --variant=minbase bookworm "$1" "${mirror:-http://deb.debian.org/debian}" >"$1.log" || {
    tail "$1.log" >&2
    return 1
  }
  rm -rf -- "$1/etc/apt" "$1.log"
  cp -r /etc/apt /etc/ssl /etc/hosts /etc/resolv.conf "$1/etc"
  mkdir -p "$1/usr/local/share"
  cp -r /usr/local/share/ca-certificates "$1/usr/local/share" 2>/dev/null || true
  cp -r /usr/share/keyrings "$1/usr/share" 2>/dev/null || true
}

# inside FOLDER COMMAND...: runs it in the Debian, in its folder /mnt.
inside() {
  local settings=(HOME=/root DEBIAN_FRONTEND=noninteractive PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin)
  mapfile -t -O "${#settings[@]}" settings < <(env | grep -iE '^(https?_proxy|no_proxy|ssl_cert_file)=' || true)
  env -i "${settings[@]}" "$(command -v chroot)" "$1" sh -c 'cd /mnt && exec "$@"' sh "${@:2}"
}
