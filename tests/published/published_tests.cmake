# The script for docs/experiments/published.md, tested against answers computed by hand, and its shortest curve. Debian's own
# Python has Debian's scipy.
add_test(NAME published.tools_and_a_short_curve COMMAND /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/published_test.py $<TARGET_FILE:clsurf>)
set_tests_properties(published.tools_and_a_short_curve PROPERTIES ENVIRONMENT "OMP_NUM_THREADS=1;OPENBLAS_NUM_THREADS=1")
add_test(NAME published.corners COMMAND /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/corners_test.py $<TARGET_FILE:clsurf>)
set_tests_properties(published.corners PROPERTIES ENVIRONMENT "OMP_NUM_THREADS=1;OPENBLAS_NUM_THREADS=1")
