#!/bin/sh
# take_built.sh compiler argument ..: compile a Fortran source, or take what the build in the folder BUILT has made of
# it. That needs the same flags, FLAGS, an object newer than the source in SOURCE_DIR, and modules in use that are the
# same to the byte; -Werror, limits of frames and -fPIC do not count, the library has the latter in any case. Without
# BUILT, and for all else, the compiler does it, with the options FURTHER too.
# The scripts of the tests set BUILT, FLAGS and SOURCE_DIR in the environment; CMake runs this as a launcher.
object='' modules=. flags='' file='' previous=''
for word; do
  case $previous$word in
    -o?*) object=$word ;;
    -J?*) modules=${word#-J} ;;
    -J | -o | -I* | -c | -fPIC | -ffree-form | -fimplicit-none | -nocpp | -Werror* | -Wframe-larger-than=*) ;;
    -*) flags="$flags $word" ;;
    *.f90) file=$word ;;
  esac
  case $word in -o | -J | -I) previous=$word ;; *) previous='' ;; esac
done

# Where fuge is a part of another project it is in the folder fuge of its build; fpm has a name for the object of its
# own.
case $object in
  *CMakeFiles/*)
    name=${object#fuge/}
    modules_built=$BUILT/${modules#fuge/}
    text=$(printf '%s\n' "$SOURCE_DIR/${name%.o}" | sed 's|CMakeFiles/[^/]*[.]dir/||')
    ;;
  *)
    name=src/CMakeFiles/fuge.dir/${file##*/src/}.o
    modules_built=$BUILT/modules
    text=$SOURCE_DIR/src/${file##*/src/}
    ;;
esac
built=$BUILT/$name
library=modules
if [ -d fuge/modules ]; then library=fuge/modules; fi

# Are there two modules $1 of the same contents, of this build and that one? One that neither has is the compiler's.
is_same() {
  for folders in "$modules $modules_built" "$library $BUILT/modules"; do
    # Word splitting is meant: two folders.
    # shellcheck disable=SC2086
    set -- "$1" $folders
    if [ -e "$2/$1.mod" ] || [ -e "$3/$1.mod" ]; then
      cmp -s "$2/$1.mod" "$3/$1.mod"
      return
    fi
  done
}

is_built() {
  [ -n "$BUILT" ] && [ -n "$object" ] && [ "$flags" = "$FLAGS" ] && [ -e "$text" ] && [ "$built" -nt "$text" ] ||
    return 1
  for module in $(sed -n 's/^ *use *\(, *[a-z]* *::\)\{0,1\} *\([a-z_0-9]*\).*/\2/p' "$text"); do
    is_same "$module" || return 1
  done
  parent=$(sed -n 's/^submodule(\([a-z_0-9]*\)).*/\1/p' "$text")
  [ -z "$parent" ] || is_same "$parent" || return 1
  declared=$(sed -n 's/^module *\([a-z_0-9]*\) *$/\1/p' "$text")
  for module in $declared; do
    [ -e "$modules_built/$module.mod" ] || return 1
  done
}

# Word splitting is meant: options.
# shellcheck disable=SC2086
is_built || exec "$@" ${FURTHER:-}
for module in $declared; do
  # As a compiler, which leaves one that has not changed.
  cmp -s "$modules_built/$module.mod" "$modules/$module.mod" || cp "$modules_built/$module.mod" "$modules" || exit 1
  # What its submodules read.
  [ ! -e "$modules_built/$module.smod" ] || cp "$modules_built/$module.smod" "$modules" || exit 1
done
cp "$built" "$object"
