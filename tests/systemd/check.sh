#!/usr/bin/env bash
# Checks the files of the service. systemd must accept them and compute a low exposure level, and
# mfard must accept the configuration. Usage: check.sh UNIT MFARD SOURCE-FOLDER. Exit status 77:
# systemd-analyze is not installed.
set -euo pipefail
unit=$1
mfard=$2
sources=$3
maxExposure=1.2
failures=0

fault() {
    printf 'FAILED: %s\n' "$*"
    failures=$((failures + 1))
}

command -v systemd-analyze >/dev/null || { echo "systemd-analyze is not installed"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# systemd requires that the program of the unit exists.
sed "s|/usr/bin/mfard|$mfard|; s|^Documentation=.*|Documentation=man:systemd(1)|" "$unit" \
    >"$work/mfard.service"
said=$(systemd-analyze verify --man=no "$work/mfard.service" 2>&1) ||
    fault "systemd-analyze verify of mfard.service ended with exit code $?"
[[ -z $said ]] || fault "systemd-analyze verify of mfard.service reports: $said"

# systemd must accept the optional drop-in that reboots after repeated failures. A failed mfard waits
# before it ends. So the interval must be long enough for the number of starts that causes a reboot.
reboot=$(dirname "$unit")/reboot.conf
install -D -m 644 "$reboot" "$work/mfard.service.d/reboot.conf"
said=$(systemd-analyze verify --man=no "$work/mfard.service" 2>&1) ||
    fault "systemd-analyze verify of reboot.conf ended with exit code $?"
[[ -z $said ]] || fault "systemd-analyze verify of reboot.conf reports: $said"
grep -qx 'StartLimitAction=reboot' "$reboot" || fault "reboot.conf has no StartLimitAction=reboot"
minutes=$(sed -n 's/^StartLimitIntervalSec=\([0-9]*\)min$/\1/p' "$reboot")
starts=$(sed -n 's/^StartLimitBurst=//p' "$reboot")
wait=$(sed -n 's/^constexpr std::chrono::seconds kLongestWait{\([0-9]*\)};$/\1/p' \
    "$sources/../daemon/restart_pause.cpp")
pause=$(sed -n 's/^RestartSec=//p' "$reboot")
[[ -n $wait ]] || fault "the longest wait was not found in restart_pause.cpp"
start=$(sed -n 's/^TimeoutStartSec=//p' "$unit")
stop=$(sed -n 's/^TimeoutStopSec=//p' "$unit")
[[ -n $start && -n $stop ]] || fault "the unit has no TimeoutStartSec= or TimeoutStopSec="
# A start takes up to $start s. If it fails, mfard waits up to $wait s and ends within $stop s. Then
# systemd waits $pause s before the next start.
((60 * minutes > starts * (start + wait + stop + pause))) ||
    fault "reboot.conf can never count $starts starts within $minutes min"
((starts * pause >= 600)) || fault "reboot.conf may reboot more often than every ten minutes"
rm -r "$work/mfard.service.d"

exposure=$(systemd-analyze security --offline=true --no-pager "$unit" |
    sed -n 's/.*Overall exposure level for [^:]*: \([0-9.]*\) .*/\1/p')
echo "exposure level from systemd-analyze security: $exposure"
awk -v e="$exposure" -v m="$maxExposure" 'BEGIN { exit !(e != "" && e <= m) }' ||
    fault "the exposure that systemd-analyze security computes is \"$exposure\"; limit: $maxExposure"

"$mfard" --check-config --config "$sources/mfard.toml" >/dev/null ||
    fault "mfard refuses the default configuration"

mkdir -p "$work/root/etc"
printf 'root:x:0:\nvideo:x:44:\n' >"$work/root/etc/group"
printf 'root:x:0:0::/root:/bin/sh\n' >"$work/root/etc/passwd"
said=$(systemd-sysusers --root="$work/root" "$sources/sysusers.conf" 2>&1) ||
    fault "systemd-sysusers refuses sysusers.conf: $said"
for group in video render gpio; do
    grep -Eq "^$group:.*:(.*,)?mfar(,|$)" "$work/root/etc/group" ||
        fault "sysusers.conf does not add the user mfar to the group $group"
done

# The exit code for a configuration error, see daemon/exit_code.h, must not cause a restart.
grep -q '^RestartPreventExitStatus=.*\<78\>' "$unit" || fault "exit code 78 would cause a restart"

# Debian 12 has systemd 252, which ignores unknown settings.
grep -Eq '^(RestartSteps|RestartMaxDelaySec|RestartMode)=' "$unit" &&
    fault "the unit has a key that needs systemd 254"
# The time budgets of the threads assume this watchdog time.
limit=$(sed -n "s/^constexpr milliseconds kWatchdog{\([0-9]*\)'000};$/\1/p" \
    "$sources/../daemon/budgets.h")
grep -qx "WatchdogSec=$limit" "$unit" || fault "WatchdogSec is not the $limit s of budgets.h"
# After certain exit codes systemd does not restart mfard. isRestarted() must exclude the same codes,
# because mfard waits before it ends only if it will be restarted.
restarted=$(sed -n '/^bool isRestarted/,/^}/p' "$sources/../daemon/restart_pause.cpp" |
    grep -o 'ExitCode::[A-Za-z]*' || true)
codes=$(sed -n 's/^    \([A-Za-z]*\) = \([1-9][0-9]*\),.*/\1 \2/p' "$sources/../daemon/exit_code.h")
excluded=$(
    while read -r name code; do
        grep -qx "ExitCode::$name" <<<"$restarted" || printf ' %s' "$code"
    done <<<"$codes"
)
[[ -n $restarted && -n $excluded ]] || fault "the exit codes were not found"
grep -qx "RestartPreventExitStatus=${excluded# }" "$unit" ||
    fault "RestartPreventExitStatus differs from the codes that isRestarted() excludes:$excluded"

# The service's resources must be limited. Its command ExecStopPost= must have no more rights than
# the service.
for key in MemoryMax OOMPolicy TasksMax LimitNOFILE LimitNICE; do
    grep -q "^$key=" "$unit" || fault "the unit has no $key="
done
grep -Eq '^ExecStopPost=-?[^+!:@]' "$unit" ||
    fault "ExecStopPost= of the service runs outside its sandbox"
grep -q "^ExecStopPost=-/.*/lib/mfar/release-trigger$" "$unit" ||
    fault "ExecStopPost= does not release the trigger line"

# is-trigger-chip must accept only the GPIO chips of the configured lines, by any of their names.
isChip() {
    printf '%s\n' "$2" >"$work/trigger.toml"
    "$sources/is-trigger-chip" "$1" "$work/sys/${3:-chip}/$1" "$work/trigger.toml"
}
mkdir -p "$work/sys/chip/gpiochip1" "$work/sys/chip/gpio/gpiochip512"
echo pinctrl-test >"$work/sys/chip/gpio/gpiochip512/label"
section=$'[cameras.trigger]\nline = "17"'
isChip gpiochip1 "$section"$'\nchip = "gpiochip1" # header' ||
    fault "is-trigger-chip refuses a chip by its name"
isChip gpiochip1 "$section"$'\nchip = "/dev/gpiochip1"' ||
    fault "is-trigger-chip refuses a chip by its path"
isChip gpiochip1 "$section"$'\nchip = "pinctrl-test"' ||
    fault "is-trigger-chip refuses a chip by its label"
isChip gpiochip1 "$section"$'\nchip = "pinctrl-other"' &&
    fault "is-trigger-chip accepts a chip with another label"
mkdir -p "$work/sys/new/gpiochip3" "$work/sys/new/gpio/chip0" "$work/sys/none/gpiochip4"
echo pinctrl-new >"$work/sys/new/gpio/chip0/label"
isChip gpiochip3 "$section"$'\nchip = "pinctrl-new"' new ||
    fault "is-trigger-chip does not read the label of a new kernel"
isChip gpiochip4 "$section"$'\nchip = "pinctrl-new"' none ||
    fault "is-trigger-chip refuses a label although the kernel tells no labels"
isChip gpiochip4 "$section"$'\nchip = "gpiochip3"' none &&
    fault "is-trigger-chip accepts another chip where the kernel tells no labels"
isChip gpiochip1 "$section" ||
    fault "is-trigger-chip refuses the chip of a line without a configured chip"
isChip gpiochip1 "$section"$'\nchip = "gpiochip10"' && fault "is-trigger-chip accepts another chip"
isChip gpiochip1 "$section"$'\nchip = ""\n[other]\nline = ""' ||
    fault "is-trigger-chip reads the line of another section"
isChip gpiochip1 $'[cameras.trigger]\nline = ""\nchip = "gpiochip1"' &&
    fault "is-trigger-chip accepts a chip without a line"
isChip gpiochip1 $'line = "17"\nchip = "gpiochip1"' &&
    fault "is-trigger-chip reads keys outside of the section"
two=$section$'\nchip = "gpiochip0"\nloopback_chip = "gpiochip1"'
isChip gpiochip1 "$two"$'\nloopback = "6"' || fault "is-trigger-chip refuses the loopback chip"
isChip gpiochip0 "$two"$'\nloopback = "6"' || fault "is-trigger-chip refuses the line's chip"
isChip gpiochip2 "$two"$'\nloopback = "6"' && fault "is-trigger-chip accepts a third chip"
isChip gpiochip1 "$two" && fault "is-trigger-chip accepts a loopback chip without a loopback input"

# Each text is TOML that sets the chip gpiochip1. mfard must accept the text, too.
chipOne=(
    $'[cameras.trigger]\r\nline = "17"\r\nchip = "gpiochip1" # header\r'
    $'[cameras.trigger]\nline=\'17\'\nchip=\'gpiochip1\''
    $' [ cameras . "trigger" ] # section\n"line" = "17"\n\'chip\' = "gpiochip1"'
    $'[cameras]\ntrigger.line = "17"\ntrigger.chip = "gpiochip1"'
    $'cameras.trigger.line = "17"\ncameras.trigger.chip = "gpiochip1"'
    $'[cameras]\ntrigger = { line = "17", chip = "gpiochip1" } # both'
    $'[[objects]]\nshape = "box"\n[cameras.trigger]\nline = "17"\nchip = "gpiochip1"'
    $'\xef\xbb\xbf[cameras.trigger]\nline = "17"\nchip = "gpiochip1"'
)
for text in "${chipOne[@]}"; do
    isChip gpiochip1 "$text" || fault "is-trigger-chip refuses the chip of: $text"
    isChip gpiochip2 "$text" && fault "is-trigger-chip accepts another chip than that of: $text"
    "$mfard" --check-config --config "$work/trigger.toml" >/dev/null || fault "mfard refuses: $text"
done
isChip gpiochip1 $'[cameras.trigger]\n# line = "17"\nchip = "gpiochip1"' &&
    fault "is-trigger-chip reads a comment"
isChip gpiochip1 $'[[cameras.trigger]]\nline = "17"' && fault "is-trigger-chip reads a list"
isChip '../gpiochip1' "$section" && fault "is-trigger-chip accepts an invalid chip name"
isChip gpiochip1 "$(cat "$sources/mfard.toml")" &&
    fault "is-trigger-chip accepts a chip although no line is configured"

[[ $failures == 0 ]]
