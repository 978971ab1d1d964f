# Decks: the cantilever of examples/data/cantilever against a calculation by hand, from three kinds of files; what is
# refused; and a case that fails beside others.
set(cantilever "${PROJECT_SOURCE_DIR}/examples/data/cantilever")
set(pch --stiffness "${cantilever}/beam.pch")
set(sti --stiffness "${cantilever}/beam.sti")
set(tables --links "${cantilever}/links.csv" --cases "${cantilever}/cases.csv" --supports "${cantilever}/supports.csv")
program_gives(deck_nastran TABLE deck_nastran ARGUMENTS --deck "${cantilever}/beam.bdf" ${pch})
program_gives(deck_calculix TABLE deck_calculix ARGUMENTS --deck "${cantilever}/beam.inp" ${sti})
program_gives(deck_tables TABLE deck_tables FIELD deck_tables_field ARGUMENTS ${tables} ${sti})
add_test(NAME program_deck_added_cases COMMAND fuge_program --deck "${cantilever}/beam.bdf" ${pch}
  --cases "${cantilever}/cases.csv")
set_tests_properties(program_deck_added_cases PROPERTIES
  PASS_REGULAR_EXPRESSION "# case 4: pressed\n.*# case 5: lifted\n.*CGAP 55,15,5, *2[.]9531.*,contact, .*,contact, ")
add_test(NAME program_deck_picture COMMAND fuge_program --deck "${cantilever}/beam.inp" ${sti} --field deck.vtu
  --output deck_picture.csv)

# A case without supports that a force pulls up has no equilibrium; the other one is solved.
file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/loose.bdf"
  "SUBCASE 1\n LOAD = 1\nSUBCASE 2\n LOAD = 1\n SPC = 1\nBEGIN BULK\n"
  "GRID,1\nGRID,2,,1.\nGRID,3,,2.\nGRID,4,,3.\nGRID,5,,4.\nGRID,15,,4.,-1.,,,123\nSPC1,1,26,1\n"
  "CGAP,7,8,15,5,,,,\nPGAP,8,.5\nFORCE,1,5,,3.,0.,1.,0.\n")
add_test(NAME program_deck_failed_case COMMAND fuge_program --deck "${CMAKE_CURRENT_BINARY_DIR}/loose.bdf" ${pch})
set_tests_properties(program_deck_failed_case PROPERTIES PASS_REGULAR_EXPRESSION
  "# case 1: SUBCASE 1\n# status: -10,.*# case 2: SUBCASE 2\n# status: 0, done.*CGAP 7,15,5,,,failed, *0[.]0+E.000, .*,open,.*1 of 2 load cases failed. SUBCASE 1: nothing holds the structure against these loads: CGAP 7 opens. node 5 moves most, in direction 2")
add_test(NAME program_deck_failed_status COMMAND fuge_program --deck "${CMAKE_CURRENT_BINARY_DIR}/loose.bdf" ${pch})
set_tests_properties(program_deck_failed_status PROPERTIES WILL_FAIL TRUE)

file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/wrong.bdf" "GRID,1\nPGAP,8,.5,,,,,.3\n")
program_refuses(deck_friction MESSAGE "wrong.bdf\", line 2, PGAP 8: MU1 is not zero" ARGUMENTS
  --deck "${CMAKE_CURRENT_BINARY_DIR}/wrong.bdf" ${pch})
program_refuses(deck_links MESSAGE "no one-way link: the deck has no CGAP" ARGUMENTS
  --deck "${PROJECT_SOURCE_DIR}/examples/data/blocks/lower.inp" ${sti})
program_refuses(deck_cases MESSAGE "no load case: the deck has no SUBCASE" ARGUMENTS
  --links "${cantilever}/links.csv" ${sti})
program_refuses(deck_rows MESSAGE "has rows without names: give the node and the direction of each by --rows" ARGUMENTS
  ${tables} --stiffness "${data}/beam_stiffness.mtx")
program_refuses(deck_stiffness MESSAGE "--stiffness is needed: the matrix of the structure" ARGUMENTS ${tables})
program_refuses(deck_mesh MESSAGE "--field a.vtu needs --mesh" ARGUMENTS --deck "${cantilever}/beam.bdf" ${pch}
  --field a.vtu)
program_refuses(deck_gap MESSAGE "--gap needs another problem than --deck and --links" ARGUMENTS ${tables} ${sti}
  --gap gap.mtx)
program_refuses(deck_pair MESSAGE "--pair needs --mesh and --pair" ARGUMENTS ${tables} ${sti} --pair A:B)
program_refuses(deck_alone MESSAGE "--cases needs --deck or --links" ARGUMENTS ${two_nodes} --load 2 --cases cases.csv)
program_refuses(deck_overwrite MESSAGE "beam.bdf: the same file as of --deck" ARGUMENTS
  --deck "${cantilever}/beam.bdf" ${pch} --output "${cantilever}/beam.bdf")
program_refuses(deck_other_matrix MESSAGE "the matrix has no row of node" ARGUMENTS
  --links "${cantilever}/links.csv" --cases "${cantilever}/cases.csv"
  --stiffness "${PROJECT_SOURCE_DIR}/examples/data/blocks/lower.sti")
# A case that holds its only link at both ends: the link moves with its supports, and the others are solved.
file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/held.bdf"
  "SUBCASE 1\n LOAD = 1\n SPC = 3\nSUBCASE 2\n LOAD = 1\n SPC = 1\nBEGIN BULK\n"
  "GRID,1\nGRID,2,,1.\nGRID,3,,2.\nGRID,4,,3.\nGRID,5,,4.\nGRID,15,,4.,-1.,,,123\nSPC1,1,26,1\nSPC,2,5,2,.25\n"
  "SPCADD,3,1,2\nCGAP,7,8,15,5,,,,\nPGAP,8,.5\nFORCE,1,4,,3.,0.,1.,0.\n")
add_test(NAME program_deck_held_link COMMAND fuge_program --deck "${CMAKE_CURRENT_BINARY_DIR}/held.bdf" ${pch})
set_tests_properties(program_deck_held_link PROPERTIES PASS_REGULAR_EXPRESSION
  "# case 1: SUBCASE 1\n# status: 0, done.*# case 2: SUBCASE 2\n# status: 0, done.*CGAP 7,15,5, *0[.]0+E.000, *7[.]50+E-001,open, *0[.]0+E.000, ")
# The program's message for a mechanism knows limits of forces: the cable yields.
file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/yielding_links.csv" "5,0,0,1,0,0,,0,2,rope\n")
file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/yielding_cases.csv" "5.2,3\n")
add_test(NAME program_deck_yield COMMAND fuge_program --links "${CMAKE_CURRENT_BINARY_DIR}/yielding_links.csv"
  --cases "${CMAKE_CURRENT_BINARY_DIR}/yielding_cases.csv" ${pch})
set_tests_properties(program_deck_yield PROPERTIES PASS_REGULAR_EXPRESSION "nothing holds the structure against these loads: rope gives way. node 5 moves most")
