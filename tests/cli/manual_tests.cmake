# The manual is up to date: docs/reference equals the program's output, man pages are valid,
# completion knows the words.
set(written ${CMAKE_CURRENT_BINARY_DIR}/reference)
add_test(NAME manual.reference_is_up_to_date COMMAND bash -c
  "rm -rf '${written}' && '$<TARGET_FILE:clsurf>' manual markdown -o '${written}' && \
   diff -ru '${PROJECT_SOURCE_DIR}/docs/reference' '${written}' || \
   { echo 'write it anew: ninja -C build/release clsurf_reference'; exit 1; }")
add_test(NAME manual.bash_completes COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/cli/completion_test
  ${PROJECT_BINARY_DIR}/manual/completion/clsurf)

# The documents: links exist, pages for users have no history of measurements, shown outputs are those of the commands.
# `update` in place of `listings` writes them.
set(check_documents python3 ${PROJECT_SOURCE_DIR}/tests/docs/check_documents.py)
add_test(NAME docs.links COMMAND ${check_documents} links ${PROJECT_SOURCE_DIR})
add_test(NAME docs.histories COMMAND ${check_documents} histories ${PROJECT_SOURCE_DIR})
add_test(NAME docs.listings COMMAND ${check_documents} listings ${PROJECT_SOURCE_DIR} $<TARGET_FILE:clsurf> README.md docs/tutorial.md)
set_tests_properties(docs.listings PROPERTIES TIMEOUT 600)
add_test(NAME docs.pictures COMMAND ${check_documents} pictures ${PROJECT_SOURCE_DIR} $<TARGET_FILE:clsurf>
  README.md docs/tutorial.md docs/guide/README.md docs/reading_a_map.md docs/formed.md)
set_tests_properties(docs.pictures PROPERTIES TIMEOUT 600)
set(wrong ${CMAKE_CURRENT_BINARY_DIR}/wrong_documents)
file(MAKE_DIRECTORY ${wrong}/docs)
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/data ${wrong}/data SYMBOLIC)
file(WRITE ${wrong}/README.md "[page](docs/page.md) [gone](docs/gone.md) [there](docs/page.md#two-words)\n\n    $ clsurf query part.nc run.biip --line 560\n    line 560: X1.874 Z4.723\n    …\n")
file(WRITE ${wrong}/docs/page.md "# Two words\n\n[a](#one-word)\n\n    [code](is/none.md)\n")
file(WRITE ${wrong}/docs/alone.md "# Alone\n")
add_test(NAME docs.wrong_links_are_found COMMAND ${check_documents} links ${wrong})
set_tests_properties(docs.wrong_links_are_found PROPERTIES PASS_REGULAR_EXPRESSION
  "^README.md: there is no docs/gone.md\ndocs/page.md: docs/page.md has no heading #one-word\ndocs/alone.md: no way leads here from README.md\n$")
set(history ${CMAKE_CURRENT_BINARY_DIR}/documents_with_history)
file(MAKE_DIRECTORY ${history}/docs/experiments)
file(WRITE ${history}/README.md "A run takes 4.3 s. Measured on 2026-11-26. On 2026-11-25, on a loaded machine, it took 83.9 s.\n")
file(WRITE ${history}/docs/page.md "Feeds before and after. `--time 2026-11-24` is later.\n\n| check | 5.3 s in a slow hour |\n")
file(WRITE ${history}/docs/experiments/page.md "On 2026-11-25, at a load of 8, it took 65.2 s.\n")
add_test(NAME docs.histories_are_found COMMAND ${check_documents} histories ${history})
set_tests_properties(docs.histories_are_found PROPERTIES PASS_REGULAR_EXPRESSION
  "^README.md: belongs to docs/experiments: On 2026-11-25, on a loaded machine, it took 83.9 s.\ndocs/page.md: belongs to docs/experiments: [|] check [|] 5.3 s in a slow hour [|]\n$")
add_test(NAME docs.wrong_listings_are_found COMMAND ${check_documents} listings ${wrong} $<TARGET_FILE:clsurf> README.md)
set_tests_properties(docs.wrong_listings_are_found PROPERTIES PASS_REGULAR_EXPRESSION
  "shown: +line 560: X1.874 Z4.723\n +printed: line 560: X1.873 Z4.723\n")

# A picture of another field for a command's picture.
file(MAKE_DIRECTORY ${wrong}/pictures)
file(WRITE ${wrong}/pictures/README.md "![mismatch](guide/mismatch.png)\n\n    clsurf render part.nc run.biip --view top -o mismatch.png\n")
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/docs/guide ${wrong}/pictures/guide SYMBOLIC)
add_test(NAME docs.wrong_pictures_are_found COMMAND ${check_documents} pictures ${wrong} $<TARGET_FILE:clsurf> pictures/README.md)
set_tests_properties(docs.wrong_pictures_are_found PROPERTIES PASS_REGULAR_EXPRESSION
  "^pictures/README.md: mismatch.png is not what 'clsurf render part.nc run.biip --view top -o mismatch.png --size 1200x900' draws\n$")

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
