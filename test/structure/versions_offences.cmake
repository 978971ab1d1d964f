# versions.cmake has to find each of these offences: cmake -D ROOT=. -D SCRATCH=.. -P versions_offences.cmake
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/planting.cmake")
foreach(folder IN ITEMS src include doc/man packages)
  file(COPY "${ROOT}/${folder}/" DESTINATION "${SCRATCH}/${folder}")
endforeach()
file(COPY "${ROOT}/fpm.toml" "${ROOT}/CITATION.cff" DESTINATION "${SCRATCH}")
file(COPY "${ROOT}/doc/install.md" "${ROOT}/doc/mpi.md" DESTINATION "${SCRATCH}/doc")

plant(src/core/fpm.toml "version = \"0.0.1\"\n" "src/core/fpm.toml has not version [0-9.]+: version = \"0.0.1\"\n")
plant(src/attic/fpm.toml "name = \"fuge_attic\"\n" "src/attic/fpm.toml gives no version\n")
plant(CITATION.cff "version: none\n" "CITATION.cff has not version [0-9.]+: version: none\n")
plant(packages/spack/packages/fuge/package.py "# fuge@9.9.9\n" "package.py has not version [0-9.]+: # fuge@9.9.9\n")
plant(doc/mpi.md "find_package(fuge 9.9)\n" "doc/mpi.md has not version [0-9.]+: find_package.fuge 9.9\n")
plant(pyproject.toml "Issues = \"https://elsewhere/issues\"\n"
  "pyproject.toml has another address than CITATION.cff: Issues")
plant(CHANGELOG.md "# Changelog\n\n## 9.9.9\n" "CHANGELOG.md begins with another version or date .*: ## 9.9.9\n")
expect_offences(versions.cmake -DROOT=${SCRATCH})
