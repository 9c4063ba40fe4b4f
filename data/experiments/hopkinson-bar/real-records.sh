#!/bin/bash
# real-records.sh KOLSKY.raw SHPB.csv: two public records of Hopkinson bars beside what the toolkit says about them, as rows
# quantity,measured,reference. The records are not part of the project; they are to be had at
#   github.com/lanl/HopPyBar            examples/LANLstandard/Cu/20061201_1148HE_CuOFE_273K.raw   (BSD-3-Clause)
#   github.com/arialolita000111/shpb-shtb-data-processor   epoxy_resin/sample_01/raw_strain.csv   (MIT)
# Without them there is nothing to do, and that is said.
set -euo pipefail
if [ $# -ne 2 ] || [ ! -r "$1" ] || [ ! -r "$2" ]; then
  sed -n '2,6s/^# \{0,1\}//p' "$0" >&2
  exit 0
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Copper between 9.47 mm bars of titanium, gauges 381 mm from the specimen, striker 127 mm. The bridge is taken for one with two
# active arms, which the file does not say: the speed is half or twice as large if it has four or one.
titanium=109.297GPa:4416kg/m3:0.3303
gauge=(--material "$titanium" --diameter 9.47mm --signal voltage --column "Incident/Reflected Waveform_V" --scale -1
  --gauge-factor 2.061 --excitation 8V --gain 200 --active-arms 2 --rest 40us)
ir-convert "$1" -o "$work/copper.csv" 2>"$work/log"
ir-waves "${gauge[@]}" --until 110us --travel 0m "$work/copper.csv" -o "$work/incident.csv"
ir-waves "${gauge[@]}" --until 110us --travel 0m --striker "127mm,9.47mm,$titanium" --summary "$work/copper.csv" >"$work/pulse.csv"
speed=$(awk -F, 'NR == 2 { print $1 }' "$work/pulse.csv")
begin=$(awk -F, 'NR == 2 { print $3 }' "$work/pulse.csv")

# The same impact predicted: striker and bar, and the pulse 640 mm down the bar, set to begin where the measured one does. With plane
# rigid faces, and with faces that are slightly crowned: a contact stiffness of 5e10 N/m^1.5, chosen to fit this pulse.
for body in striker bar; do
  [ $body = striker ] && segment="127mm,9.47mm,$titanium --face B" || segment="1m,9.47mm,$titanium --face A --far-end infinite"
  ir-bar --segment $segment --step 0.1us --duration 300us -o "$work/$body.csv"
done
predict() { # NAME [LAW...]
  local name=$1
  shift
  ir-impact --speed "${speed}m/s" "$@" "$work/striker.csv" "$work/bar.csv" -o "$work/impact.csv"
  ir-waves --material "$titanium" --diameter 9.47mm --signal force --travel 640mm "$work/impact.csv" -o "$work/gauge.csv"
  ir-waves --material "$titanium" --diameter 9.47mm --travel 0m --striker "127mm,9.47mm,$titanium" --summary "$work/gauge.csv" >"$work/$name-pulse.csv"
  shift_s=$(awk -F, 'FNR == 2 { b[++n] = $3 } END { print b[2] - b[1] }' "$work/pulse.csv" "$work/$name-pulse.csv")
  awk -F, -v OFS=, -v from="$shift_s" -v begin="$begin" '
    NR == FNR { if (FNR > 1) f[FNR - 2] = $2; n = FNR - 1; next }
    FNR == 1 { print "time_s,force_N,predicted_N"; next }
    $1 >= begin - 20e-6 && $1 <= begin + 100e-6 {
      at = ($1 + from) / 1e-7; k = int(at); p = k >= 0 && k + 1 < n ? f[k] + (at - k) * (f[k + 1] - f[k]) : 0
      if (!started) { started = 1; zero = $1 }
      printf "%.10g,%.9g,%.9g\n", $1 - zero, $2, p }' "$work/gauge.csv" "$work/incident.csv" >"$work/$name.csv"
}
predict rigid
predict crowned --law hertz --stiffness 5e10N/m^1.5

echo quantity,measured,reference
awk -F, 'FNR == 2 { l[++n] = $4 * 1e6; v = $1; r = $5 * 1e6 }
  END { printf "copper: striker speed in m/s for two active arms (reference: not recorded),%.2f,\n", v
        printf "copper: pulse length in us (reference 2L/c0),%.2f,%.2f\n", l[2], r
        printf "copper: pulse length in us (reference: predicted at the gauge),%.2f,%.2f\n", l[2], l[1] }' "$work/rigid-pulse.csv" "$work/pulse.csv"
for contact in rigid crowned; do
  awk -F, -v contact="$contact" 'NR > 1 { e += ($2 - $3)^2; s += $2^2; if ($2 > p) p = $2; if ($3 > q) q = $3 }
    END { printf "copper: L2 difference of predicted and measured pulse; %s faces,%.3f,0\n", contact, sqrt(e / s)
          printf "copper: peak force in N (reference: predicted; %s faces),%.0f,%.0f\n", contact, p, q }' "$work/$contact.csv"
done

# First crossings of half the pulse, at a level of the strain: incident, reflected, and the incident's next passage.
crossing() { # FILE COLUMN LEVEL FROM: first time after FROM at which COLUMN crosses LEVEL away from 0
  awk -F, -v column="$2" -v level="$3" -v from="$4" 'NR > 1 && $1 >= from { x = $column / level; if (x > 1 && last <= 1) { printf "%.8g\n", t + ($1 - t) * (1 - last) / (x - last); exit } last = x; t = $1 }' "$1"
}
incident=$(crossing "$work/copper.csv" 2 1.6 -50e-6)
reflected=$(crossing "$work/copper.csv" 2 -1.4 100e-6)
again=$(crossing "$work/copper.csv" 2 1.3 250e-6)
awk -v a="$incident" -v b="$reflected" -v c="$again" 'BEGIN {
  printf "copper: incident to reflected at half height in us (reference: the calibration noted in the file),%.2f,156.6\n", (b - a) * 1e6
  printf "copper: reverberation period in us (reference: the length of the bar is not recorded),%.2f,\n", (c - a) * 1e6 }'

# Epoxy between steel bars of 20 mm; incident bar 2100 mm, gauge 1018 mm from the specimen.
ir-convert "$2" -o "$work/epoxy.csv" 2>>"$work/log"
incident=$(crossing "$work/epoxy.csv" 2 -2.5e-7 -190e-6)
over=$(awk -F, -v from="$incident" 'NR > 1 && $1 > from + 100e-6 { if ($2 > -2.5e-7 && last <= -2.5e-7) { printf "%.8g\n", t + ($1 - t) * (-2.5e-7 - last) / ($2 - last); exit } last = $2; t = $1 }' "$work/epoxy.csv")
reflected=$(crossing "$work/epoxy.csv" 2 1.7e-7 300e-6)
again=$(crossing "$work/epoxy.csv" 2 -2.0e-7 700e-6)
awk -v a="$incident" -v o="$over" -v b="$reflected" -v c="$again" 'BEGIN { c0 = sqrt(210e9 / 7800)
  printf "epoxy: pulse length in us (reference: the length of the striker is not recorded),%.2f,\n", (o - a) * 1e6
  printf "epoxy: incident to reflected at half height in us (reference 2d/c0),%.2f,%.2f\n", (b - a) * 1e6, 2 * 1.018 / c0 * 1e6
  printf "epoxy: reverberation period in us (reference 2L/c0),%.2f,%.2f\n", (c - a) * 1e6, 2 * 2.1 / c0 * 1e6 }'
