#!/usr/bin/env bash
# The service's files are sound: systemd understands them, little is exposed, and mfard accepts the
# configuration. Usage: check.sh UNIT MFARD SOURCE-FOLDER. Exit status 77: skipped.
set -euo pipefail
unit=$1
mfard=$2
sources=$3
maxExposure=2.0
failures=0

fault() {
    printf 'FAILED: %s\n' "$*"
    failures=$((failures + 1))
}

command -v systemd-analyze >/dev/null || { echo "systemd-analyze is not installed"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# systemd wants to see the program that the unit names.
sed "s|/usr/bin/mfard|$mfard|; s|^Documentation=.*|Documentation=man:systemd(1)|" "$unit" \
    >"$work/mfard.service"
said=$(systemd-analyze verify --man=no "$work/mfard.service" 2>&1) || fault "verify ended with $?"
[[ -z $said ]] || fault "verify: $said"

exposure=$(systemd-analyze security --offline=true --no-pager "$unit" |
    sed -n 's/.*Overall exposure level for [^:]*: \([0-9.]*\) .*/\1/p')
echo "exposure $exposure"
awk -v e="$exposure" -v m="$maxExposure" 'BEGIN { exit !(e != "" && e <= m) }' ||
    fault "exposure is \"$exposure\", at most $maxExposure"

"$mfard" --check-config --config "$sources/mfard.toml" >/dev/null ||
    fault "mfard refuses the default configuration"

mkdir -p "$work/root/etc"
printf 'root:x:0:\nvideo:x:44:\n' >"$work/root/etc/group"
printf 'root:x:0:0::/root:/bin/sh\n' >"$work/root/etc/passwd"
said=$(systemd-sysusers --root="$work/root" "$sources/sysusers.conf" 2>&1) ||
    fault "sysusers: $said"
for group in video render gpio; do
    grep -Eq "^$group:.*:(.*,)?mfar(,|$)" "$work/root/etc/group" || fault "mfar is not in $group"
done

# The configuration error of daemon/exit_code.h must not be tried again.
grep -q '^RestartPreventExitStatus=.*\<78\>' "$unit" || fault "exit code 78 would restart"

# Debian 12 has systemd 252, which ignores what it does not know.
grep -Eq '^(RestartSteps|RestartMaxDelaySec|RestartMode)=' "$unit" &&
    fault "a key that needs systemd 254"
# The budgets of the threads are made for this limit.
limit=$(sed -n "s/^constexpr milliseconds kWatchdog{\([0-9]*\)'000};$/\1/p" \
    "$sources/../daemon/budgets.h")
grep -qx "WatchdogSec=$limit" "$unit" || fault "WatchdogSec is not the $limit s of budgets.h"
# Every code that is started again is one that mfard waits out.
grep -qx 'RestartPreventExitStatus=64 65 66 78' "$unit" || fault "isRestarted() knows other codes"

[[ $failures == 0 ]]
