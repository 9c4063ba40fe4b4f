# How numbers look on the page.

# number(value, decimals): thousands in narrow groups, a true minus; a dash where there is no value.
function number(value, decimals,    text, sign, whole, rest, grouped) {
  if (value == "") return "–"
  text = sprintf("%." decimals "f", value)
  sign = ""
  if (text ~ /^-/) { text = substr(text, 2); if (text + 0 != 0) sign = "−" }
  whole = text; rest = ""
  if (index(text, ".")) { whole = substr(text, 1, index(text, ".") - 1); rest = substr(text, index(text, ".")) }
  grouped = ""
  while (length(whole) > 4 || (grouped != "" && length(whole) > 3)) {
    grouped = " " substr(whole, length(whole) - 2) grouped
    whole = substr(whole, 1, length(whole) - 3)
  }
  return sign whole grouped rest
}

# minutes(seconds): 2:41
function minutes(seconds) { return sprintf("%d:%02d", int(seconds / 60), seconds - 60 * int(seconds / 60)) }

# name_columns(): column["peak_force_N"] from the header that has just been read.
function name_columns(    i) { for (i = 1; i <= NF; ++i) column[$i] = i }
function value(name) { return $(column[name]) }

# run_method(stem), run_step(stem): what a file named modal-10us holds.
function run_method(stem) { sub(/-[0-9.]+us$/, "", stem); return stem == "waves" ? "travelling waves" : stem == "modal" ? "modes, trapezoidal" : stem == "fe" ? "finite elements" : stem }
function run_step(stem) { sub(/^.*-/, "", stem); sub(/us$/, "", stem); return stem }
