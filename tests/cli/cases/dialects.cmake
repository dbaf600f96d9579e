# How the dialect of a program is chosen, and what is refused.

# ---- the guess ----
clsurf_cli_test(NAME dialect_of_polar_words SETUP "printf '(holes)\\nG0 @3 ^45\\nG0 ^90\\nM2\\n' > part.nc" ARGS info part.nc
  STDOUT "dialect linuxcnc .a guess: '.' in line 2.")
clsurf_cli_test(NAME dialect_of_the_ending SETUP "printf 'G21\\nG0 X1\\nM2\\n' > part.ngc" ARGS info part.ngc
  STDOUT "dialect linuxcnc .a guess: the ending .ngc.")
clsurf_cli_test(NAME dialect_given_is_no_guess SETUP "printf 'G21\\nG0 X1\\nM2\\n' > part.ngc" ARGS info part.ngc --dialect fanuc
  STDOUT "dialect fanuc" NO_STDOUT "a guess")
clsurf_cli_test(NAME dialect_guess_in_json SETUP "printf 'G21\\nG0 X1\\nM2\\n' > part.ngc" ARGS info part.ngc --json
  STDOUT "\"dialect\": \"linuxcnc\"" "\"dialect_guessed_from\": \"the ending .ngc\"")
clsurf_cli_test(NAME dialect_guess_in_an_error SETUP "printf 'O1000\\nG0 X0 Y0\\nG2 X10 Y0 I4 F60\\n' > part.nc" ARGS moves part.nc
  EXIT 3 STDERR "part.nc:3:1: error: arc radius differs" "hint: read as fanuc, a guess .'O1000' in line 1.. choose another with --dialect")

# ---- words that move axes and are not understood ----
clsurf_cli_test(NAME spline_of_another_dialect
  SETUP "printf 'G21 G90\\nG0 X0 Y0 Z0\\nG5.2 X1 Y1 P1 L3\\nX2 Y2 P1\\nG5.3\\nM30\\n' > part.nc"
  ARGS simulate part.nc --dialect fanuc -o run.biip EXIT 3 STDERR "part.nc:3:1: error: G5.2 is not known in fanuc" "--dialect linuxcnc"
  NO_FILE run.biip)
clsurf_cli_test(NAME nurbs_that_does_not_end SETUP "printf 'G21 G90\\nG0 X1 Y1 Z0\\nG6.2 P3 K0 X1 Y1 R1 F600\\nK0 X2\\nK0 X3 Y2\\nK1\\nM30\\n' > part.nc"
  ARGS simulate part.nc -o run.biip EXIT 3 STDERR "part.nc:7: error: a spline .G6.2. ends with 3 blocks of K alone, here are 1" NO_FILE run.biip)
clsurf_cli_test(NAME polynomials_of_another_mode
  SETUP "printf 'G71 G90\\nG0 X0 Y0 Z0\\nG1 F1000\\nPO[X]=(5,1) PO[Y]=(3,2)\\nM30\\n' > part.mpf"
  ARGS simulate part.mpf -o run.biip EXIT 3 STDERR "part.mpf:4:1: error: PO moves axes, but POLY is not in force" NO_FILE run.biip)
clsurf_cli_test(NAME exact_stop_is_no_g61_of_siemens SETUP "printf 'G71 G90 G61\\nG0 X0\\nM30\\n' > part.mpf" ARGS moves part.mpf
  EXIT 3 STDERR "part.mpf:1:9: error: G61 is not a word of siemens" "exact stop of siemens is G60")

# ---- LinuxCNC's spirals ----
clsurf_cli_test(NAME spiral_of_linuxcnc SETUP "printf 'G21\\nF100\\nG2 X50 Y0 I24.986\\nM2\\n' > part.ngc" ARGS moves part.ngc
  STDOUT "3,cw,50,0,0,,,,24.986")

# ---- messages obey no control characters ----
clsurf_cli_test(NAME binary_as_a_program SETUP "printf 'G0 X1\\n\\001\\033\\377\\n' > part.nc"
  ARGS moves part.nc EXIT 3 STDERR "part.nc:2:[0-9]+: error: expected a word, found '.x01'")

# ---- Klartext ----
clsurf_cli_test(NAME klartext_is_recognised ARGS info @DATA@/programs/wave.H STDOUT "dialect klartext .a guess: 'BEGIN PGM' in line 1" "4 arcs")
clsurf_cli_test(NAME klartext_corner_and_circle ARGS moves @DATA@/programs/wave.H
  STDOUT "1592,ccw,29,-2,-4,,,,26,-2,-4,1,17,1200" "1597,ccw,0,-5,-4.5,,,,0,5,-4.5,1,17,1200")
clsurf_cli_test(NAME klartext_lint ARGS lint @DATA@/programs/wave.H EXIT 1 STDOUT "wave.H:183-257: warning: points 0.021 mm apart")
clsurf_cli_test(NAME klartext_approach SETUP "printf '0 BEGIN PGM A MM\\n1 L X+0 Y+0 Z+0 FMAX\\n2 APPR LT X+20 Y+20 LEN15 F100\\n3 END PGM A MM\\n' > part.h"
  ARGS moves part.h EXIT 3 STDERR "part.h:3:3: error: APPR is not supported in klartext, and moves axes")
clsurf_cli_test(NAME klartext_simulated SETUP "printf '0 BEGIN PGM A MM\\n1 CYCL DEF 32.1 T0.02\\n2 L X+0 Y+0 Z+0 FMAX\\n3 L X+20 F3000\\n4 L Y+20\\n5 END PGM A MM\\n' > part.h"
  ARGS simulate part.h -o run.biip STDOUT "greatest path speed +(2[89]..|3000) mm/min")
