# Run by cmake --install for the component swell_package alone: its licence, those of what is compiled in, and its
# history, where Debian looks for them. The history is one entry at the time of SOURCE_DATE_EPOCH, or now.
cmake_policy(VERSION 3.25)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(notes ${swell_binary_folder}/packages/${swell_package})
file(WRITE ${notes}/changelog "swell (${swell_version}) stable; urgency=medium

  * Version ${swell_version}: swell-doc has its CHANGELOG.md.

 -- ${swell_contact}  ${date}
")
execute_process(COMMAND gzip -9nf ${notes}/changelog COMMAND_ERROR_IS_FATAL ANY)
set(folder ${CMAKE_INSTALL_PREFIX}/share/doc/${swell_package})
file(INSTALL DESTINATION ${folder} TYPE FILE FILES ${notes}/changelog.gz)
file(READ ${swell_source_folder}/LICENSE licence)
file(READ ${swell_source_folder}/cmake/notices.txt notices)
file(WRITE ${notes}/copyright "${licence}\n${notices}")
file(INSTALL DESTINATION ${folder} TYPE FILE FILES ${notes}/copyright)
