# The manual against the tables: docs/reference is what the program writes now, man pages are sound,
# completion knows the words.
set(written ${CMAKE_CURRENT_BINARY_DIR}/reference)
add_test(NAME manual.reference_is_up_to_date COMMAND bash -c
  "rm -rf '${written}' && '$<TARGET_FILE:clsurf>' manual markdown -o '${written}' && \
   diff -ru '${PROJECT_SOURCE_DIR}/docs/reference' '${written}' || \
   { echo 'write it anew: ninja -C build/release clsurf_reference'; exit 1; }")
add_test(NAME manual.bash_completes COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/cli/completion_test
  ${PROJECT_BINARY_DIR}/manual/completion/clsurf)
find_program(MAN man)
if(MAN)
  add_test(NAME manual.pages_are_sound COMMAND bash -c
    "cd '${PROJECT_BINARY_DIR}/manual' && for page in *.1; do \
       LC_ALL=C.UTF-8 MANWIDTH=80 '${MAN}' --warnings -l $page 2>&1 >/dev/null | sed \"s/^/$page: /\"; \
     done | grep . && exit 1 || exit 0")
endif()
find_program(ZSH zsh)
if(ZSH)
  add_test(NAME manual.zsh_completes COMMAND ${ZSH} -f ${CMAKE_CURRENT_SOURCE_DIR}/cli/completion_test.zsh ${PROJECT_BINARY_DIR}/manual/completion)
endif()
find_program(FISH fish)
if(FISH)
  add_test(NAME manual.fish_completes COMMAND ${FISH} --no-config ${CMAKE_CURRENT_SOURCE_DIR}/cli/completion_test.fish ${PROJECT_BINARY_DIR}/manual/completion/clsurf.fish)
endif()
