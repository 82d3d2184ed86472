#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Runs the paper's experiments and writes one self-contained page about them, report.html.
#
#   scripts/report.sh [--quick] [--out DIR] [--seven-scenes DIR] [--recording NAME=SEQUENCE]... [--seed N] [--device cpu|cuda] [--bin DIR]
#
#   --quick           three rooms and few frames: minutes instead of most of an hour
#   --out DIR         where results, rendered rooms and the page go (default: build/report, or build/report-quick)
#   --seven-scenes    a folder that holds scenes of 7-Scenes (chess, fire, ...; docs/7scenes.md); each is run with its official split
#   --recording       a recording of its own; its halves are learnt and tested in turn, and tracking is lost at each of its frames
#   --bin DIR         programs that are built already; otherwise they are built
#
# An interrupted report goes on where it stopped: each experiment's JSON is kept, and run again only if the programs or its options changed.
# Numbers of accuracy are equal for equal seeds (accuracy.json holds just those); times are not.
set -euo pipefail

main() { # read to its end before it runs, so that the file may change meanwhile
  caller=$PWD
  cd "$(dirname "$0")/.."
  repository=$PWD

  usage() { sed -n '5,15p' "$repository/scripts/report.sh" | sed 's/^# \{0,1\}//' >&2; }
  refuse() {
    echo "report: $1" >&2
    usage
    exit 2
  }
  absolute() { [[ $1 == /* ]] && echo "$1" || echo "$caller/$1"; }

  quick=false out="" seven_scenes="" bin="" seed=42 device=cpu
  recordings=()
  while [[ $# -gt 0 ]]; do
    case $1 in
      --quick) quick=true ;;
      --help | -h) usage; exit 0 ;;
      --out | --seven-scenes | --recording | --seed | --device | --bin)
        [[ $# -ge 2 ]] || refuse "$1: expected a value"
        case $1 in
          --out) out=$(absolute "$2") ;;
          --seven-scenes) seven_scenes=$(absolute "$2") ;;
          --recording)
            [[ $2 =~ ^[A-Za-z0-9_-]+=.+ ]] || refuse "--recording: got '$2', expected NAME=SEQUENCE"
            recordings+=("${2%%=*}=$(absolute "${2#*=}")")
            ;;
          --seed) seed=$2 ;;
          --device) device=$2 ;;
          --bin) bin=$(absolute "$2") ;;
        esac
        shift
        ;;
      *) refuse "unknown argument '$1'" ;;
    esac
    shift
  done
  if [[ -z $out ]]; then
    out=$repository/build/report
    if $quick; then out+=-quick; fi
  fi

  if [[ -z $bin ]]; then
    scripts/build.sh release relocalisation_benchmark render_sequence train_forest
    bin=$repository/build/release/bin
  fi
  benchmark=$bin/relocalisation_benchmark
  for program in relocalisation_benchmark render_sequence train_forest; do
    [[ -x $bin/$program ]] || refuse "$bin/$program: not found; expected a built program"
  done

  # What the suite is made of. Rooms are rendered at 30 frames a second, of which every stride-th is kept.
  if $quick; then
    rooms=(kitchen office stairs) trained=(office) frames=240 stride=8 training_stride=1
    timed_training=24 timed_tests=6 confidence_stride=2 recording_stride=25 failing=(stairs) failures=1
    places=1,2,4 trust_options=(--quick --rooms 3)
    kidnapped=(kitchen) kidnap_frames=120 kidnap_options=(--removed 2 --teleports 2 --removed-length 25 --judged 15)
  else
    rooms=(office stairs kitchen textureless workshop bookshelf lounge) trained=(office kitchen stairs) frames=600 stride=4 training_stride=2
    timed_training=120 timed_tests=30 confidence_stride=2 recording_stride=5 failing=(stairs office) failures=1
    places=1,2,4,8,16,24 trust_options=()
    kidnapped=(kitchen office) kidnap_frames=400 kidnap_options=(--removed 8 --teleports 8 --removed-length 45 --judged 30)
  fi

  mkdir -p "$out/scenes" "$out/results" "$out/forests"
  cd "$out" # experiments name scenes relative to it, so that results do not depend on where it lies
  started=$SECONDS
  programs=$(sha256sum "$bin"/{relocalisation_benchmark,render_sequence,train_forest} | cut -d' ' -f1 | sha256sum | cut -d' ' -f1)

  say() { printf '%4d:%02d  %s\n' $(((SECONDS - started) / 60)) $(((SECONDS - started) % 60)) "$1" >&2; }

  # once STAMP WHAT COMMAND...: runs a command unless it succeeded before, with the same programs.
  once() {
    local stamp=$1 what=$2
    shift 2
    if [[ -f $stamp && $(<"$stamp") == "$programs $*" ]]; then
      say "$what: kept from before"
      return
    fi
    say "$what"
    local begin=$SECONDS status=0
    "$@" >"$stamp.out" || status=$?
    if [[ $status -ne 0 ]]; then
      [[ $status -eq 130 ]] && echo "report: interrupted; run it again to go on from here" >&2 || echo "report: failed: $*" >&2
      exit "$status"
    fi
    printf '%s' "$((SECONDS - begin))" >"$stamp.seconds"
    printf '%s %s' "$programs" "$*" >"$stamp"
  }

  # experiment NAME WHAT ARGUMENT...: runs the benchmark; its results go to results/NAME.json.
  experiment() {
    local name=$1 what=$2
    shift 2
    once "results/$name.stamp" "$what" "$benchmark" "$@" --seed "$seed" --device "$device" --json "results/$name.json"
  }

  render() { # SCENE SEQUENCE SPEC STRIDE
    local folder=scenes/$1/$2 spec=$3
    if [[ ! -f $folder.stamp || $(<"$folder.stamp") != "$programs "* ]]; then rm -rf "$folder"; fi
    mkdir -p "scenes/$1"
    if [[ ! -f $folder.stamp ]]; then rm -rf "$folder"; fi # an interrupted rendering begins anew
    once "$folder.stamp" "rendering $1/$2" "$bin/render_sequence" --sequence "$spec" --stride "$4" --out "$folder"
  }

  for room in "${rooms[@]}"; do
    render "$room" seq-01 "synthetic:$room?frames=$frames" "$stride"
    render "$room" seq-02 "synthetic:$room?frames=$frames&trajectory=test" "$stride"
    # The same path in another hand, between the frames that are learnt: views that are hardly novel.
    render "$room" seq-03 "synthetic:$room?frames=$frames&seed=7@$((stride / 2)):" "$((2 * stride))"
    echo sequence1 >"scenes/$room/TrainSplit.txt"
    echo sequence2 >"scenes/$room/TestSplit.txt"
  done

  forests=(--forest default --forest data-free=random)
  for room in "${trained[@]}"; do
    once "forests/$room.stamp" "training a forest on $room" "$bin/train_forest" --sequence "scenes/$room/seq-01" --out "forests/$room.forest" --resume \
      --stride "$training_stride" --examples-per-frame 250 --depth 13 --seed "$seed" --set rolled_copies=1 --set variance_weight=0 --set agreement_weight=1
    forests+=(--forest "$room=forests/$room.forest")
  done

  room_scenes=() novel_scenes=()
  for room in "${rooms[@]}"; do
    room_scenes+=(--scene "$room=scenes/$room")
    novel_scenes+=(--scene "$room=scenes/$room/seq-01,scenes/$room/seq-03,scenes/$room/seq-02")
  done

  methods=forest,ferns forest_methods=forest,forest+icp novel_methods=forest,forest+icp,forest+icp+rank,ferns
  experiment rooms.adapt "adapting forests to the rooms" adapt "${room_scenes[@]}" "${forests[@]}" --method "$forest_methods"
  for room in "${rooms[@]}"; do
    experiment "rooms.loss.$room" "losing track in $room" loss --sequence "scenes/$room/seq-02" --method "$methods" --csv "results/rooms.loss.$room.csv"
  done
  experiment rooms.novel "novel views of the rooms" novel "${novel_scenes[@]}" --method "$novel_methods"
  experiment rooms.confidence "what confidence is worth" confidence "${novel_scenes[@]}" --stride "$confidence_stride" --method "$novel_methods"
  experiment rooms.time "timing" time --sequence "scenes/${rooms[0]}/seq-01" --train-frames "$timed_training" --test-frames "$timed_tests" --method "$methods,paper" --threads 1
  for room in "${failing[@]}"; do
    experiment "rooms.failures.$room" "looking into failures in $room" failures --scene "$room=scenes/$room" --count "$failures" --pictures "results/rooms.failures.$room"
  done
  for room in "${kidnapped[@]}"; do
    render "$room" dense "synthetic:$room?frames=$kidnap_frames" 1 # tracking needs every frame
    experiment "rooms.kidnap.$room" "kidnaps in $room" kidnap --sequence "scenes/$room/dense" --method "$methods" "${kidnap_options[@]}"
  done

  if [[ -n $seven_scenes ]]; then
    scenes=()
    for scene in chess fire heads office pumpkin redkitchen stairs; do
      if [[ -d $seven_scenes/$scene ]]; then scenes+=(--scene "$scene=$seven_scenes/$scene"); fi
    done
    [[ ${#scenes[@]} -gt 0 ]] || refuse "--seven-scenes: $seven_scenes holds none of chess, fire, heads, office, pumpkin, redkitchen, stairs"
    sparse=()
    if $quick; then sparse=(--stride "$recording_stride"); fi
    experiment 7scenes.adapt "adapting forests to 7-Scenes" adapt "${scenes[@]}" "${forests[@]}" --method "$forest_methods" "${sparse[@]}"
    experiment 7scenes.novel "novel views of 7-Scenes" novel "${scenes[@]}" --method "$novel_methods" "${sparse[@]}"
    experiment 7scenes.confidence "what confidence is worth on 7-Scenes" confidence "${scenes[@]}" --stride "$recording_stride" --method "$methods"
  fi

  halves=() strangers=() # the next scene's views must not be of the same place where confidence is asked about strangers
  for recording in "${recordings[@]}"; do
    name=${recording%%=*} sequence=${recording#*=}
    count=$(find "$sequence/" -maxdepth 1 -name 'frame-*.depth.png' | wc -l)
    [[ $count -ge 4 ]] || refuse "--recording: $sequence holds $count frames in the layout of 7-Scenes; expected at least 4"
    first="$sequence@0:$((count / 2))" second="$sequence@$((count / 2)):$count"
    halves+=(--scene "$name-forth=$first,$second" --scene "$name-back=$second,$first")
    strangers+=(--scene "$name=$first,$second")
    experiment "recordings.loss.$name" "losing track in $name" loss --sequence "$sequence" --method "$methods" --stride "$((recording_stride / 5))" --csv "results/recordings.loss.$name.csv" --threads 1 --exclusive-timing
    experiment "recordings.gap.$name" "losing track in $name, 30 frames ahead" loss --sequence "$sequence" --method "$methods" --stride "$((recording_stride / 5))" --gap "$((30 * 5 / recording_stride))" \
      --csv "results/recordings.gap.$name.csv" --threads 1 --exclusive-timing
    if ! $quick; then
      experiment "recordings.kidnap.$name" "kidnaps in $name" kidnap --sequence "$sequence" --method "$methods" --removed 10 --teleports 10
    fi
  done
  if [[ ${#halves[@]} -gt 0 ]]; then
    experiment recordings.adapt "adapting forests to recordings" adapt "${halves[@]}" "${forests[@]}" --method "$forest_methods" --stride "$recording_stride"
    experiment recordings.novel "novel views of recordings" novel "${halves[@]}" --method "$novel_methods" --stride "$recording_stride"
    experiment recordings.confidence "what confidence is worth on recordings" confidence "${strangers[@]}" --method "$methods" --stride "$recording_stride"
  fi

  experiment rooms.scale "many places in one map" scale --rooms "$places"
  experiment rooms.trust "how far answers can be trusted" trust "${trust_options[@]}" "${strangers[@]}" --stride "$recording_stride"

  commit=$(git -C "$repository" rev-parse --short HEAD 2>/dev/null || echo unknown)
  if [[ $commit != unknown && -n $(git -C "$repository" status --porcelain --untracked-files=no) ]]; then commit+=" with changes"; fi
  say "writing the page"
  python3 -B "$repository/scripts/report" --results results --commit "$commit" --seed "$seed" --quick "$quick" --out report.html --accuracy accuracy.json
  say "done: $out/report.html"
}
main "$@"
exit
