# Runs the command, and writes what it made into one page of HTML, pictures and all. Sourced by examples/tour, which sets
# `command`, the program, and `page`, the file to write.
# shellcheck shell=sh disable=SC2154  # both come from there
count=0          # of commands
spent_ms=0       # by all of them

now_ms() { echo $(($(date +%s%N) / 1000000)); }
escaped() { sed -e 's/&/\&amp;/g' -e 's/</\&lt;/g' -e 's/>/\&gt;/g'; }
put() { printf '%s\n' "$*" >>"$page"; }
# The words as one would type them: quoted where the shell would take them apart.
typed() {
  text=$1
  shift
  for word in "$@"; do
    case $word in
      *[!A-Za-z0-9_./:=,@%+-]* | '') text="$text '$word'" ;;
      *) text="$text $word" ;;
    esac
  done
  printf '%s\n' "$text"
}

# run WORD...: azulejo with these words. Leaves what was typed in $shown, and in $took how long it was, in ms.
run() {
  shown=$(typed azulejo "$@")
  echo "$shown" >&2
  before=$(now_ms)
  "$command" "$@"
  took=$(($(now_ms) - before))
  count=$((count + 1))
  spent_ms=$((spent_ms + took))
}

data_uri() {
  case $1 in
    *.jpg) printf 'data:image/jpeg;base64,' ;;
    *) printf 'data:image/%s;base64,' "${1##*.}" ;;
  esac
  base64 -w0 "$1"
}

size_of() { "$command" info "$1" | sed -n 's/^ *\([0-9]*×[0-9]*\),.*/\1/p'; }
kilobytes() { echo "$((($(wc -c <"$1") + 512) / 1024)) KB"; }

begin_page() {
  : >"$page"
  put '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">'
  put '<meta name="viewport" content="width=device-width, initial-scale=1"><title>azulejo: a gallery</title><style>'
  cat "$1" >>"$page"
  put "</style></head><body><div class=frieze style=\"--wall:url($(data_uri "$2"))\"></div>"
}

# section ID TITLE SENTENCE [CLASS of its grid]
section() { put "<section id=$1><h2>$2</h2><p>$3</p><div class=\"grid ${4-}\">"; }
end_section() { put '</div></section>'; }

# caption TITLE NOTE: below a picture of the command that ran last.
caption() {
  put "<figcaption><b>$1</b><code>$(printf '%s\n' "$shown" | escaped | sed 's/[^ ]*/<i>&<\/i>/g')</code><span>$2</span></figcaption></figure>"
}
seconds() { printf '%d.%02d s' $(($1 / 1000)) $(($1 % 1000 / 10)); }

# show FILE TITLE: a picture that the last command made.
show() {
  printf '<figure><label class=stage><input type=checkbox aria-label="full size"><img alt="%s" src="' "$2" >>"$page"
  data_uri "$1" >>"$page"
  put '"></label>'
  caption "$2" "$(seconds "$took") · $(size_of "$1") · $(kilobytes "$1")"
}
# picture FILE TITLE WORD...: runs azulejo, and shows what it made.
picture() {
  file=$1 title=$2
  shift 2
  run "$@"
  show "$file" "$title"
}
# moving TITLE FILE...: frames that the last command made, as a film.
moving() {
  title=$1
  shift
  put "<figure><span class=turn style=\"--frames:$#\">"
  frame=0
  for file in "$@"; do
    printf '<img alt="" style="--frame:%d" src="%s">' $frame "$(data_uri "$file")" >>"$page"
    frame=$((frame + 1))
  done
  put '</span>'
  caption "$title" "$(seconds "$took") · $# frames of $(size_of "$1")"
}
# written TITLE FILE: text that the last command made.
written() {
  put "<figure><pre>$(escaped <"$2")</pre>"
  caption "$1" "$(seconds "$took")"
}

# end_page MODELS: what it was made with.
end_page() {
  processor=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1)
  memory=$(awk '/^MemTotal/ { printf "%.0f GiB", $2 / 1048576 }' /proc/meminfo)
  system=$(sed -n 's/^PRETTY_NAME="\(.*\)"/\1/p' /etc/os-release)
  put '<footer><dl>'
  put "<dt>commands</dt><dd>$count, $(seconds $spent_ms) together; each time is that of the whole command, from start to file</dd>"
  put "<dt>models</dt><dd>$1</dd>"
  put "<dt>machine</dt><dd>${processor:-unknown}, $(nproc) processors for this, $memory; no GPU was asked</dd>"
  put "<dt>system</dt><dd>${system:-unknown}, $(uname -srm), $("$command" --version)</dd>"
  put '</dl></footer></body></html>'
}
