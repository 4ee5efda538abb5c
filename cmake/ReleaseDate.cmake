# SPDX-License-Identifier: GPL-3.0-or-later
# release_date(OUT VERSION CHANGELOG FORMAT): the date of the Debian changelog, the same for every build of the same
# sources. The first of these that is there:
#   - SOURCE_DATE_EPOCH of the environment, as reproducible builds set it
#   - the date of VERSION's section in CHANGELOG: `## VERSION, YYYY-MM-DD`
#   - of a version that is not released: the commit's, by git; without git that of the newest section with a date
# FORMAT is that of string(TIMESTAMP), in UTC.
function(release_date out version changelog format)
  if(NOT "$ENV{SOURCE_DATE_EPOCH}" STREQUAL "")
    set(epoch $ENV{SOURCE_DATE_EPOCH})
  else()
    file(STRINGS ${changelog} dated REGEX "^## [0-9.]+, [0-9]+-[0-9]+-[0-9]+$")
    set(sections ${dated})
    list(FILTER sections INCLUDE REGEX "^## ${version}, ")
    if(NOT sections)
      cmake_path(GET changelog PARENT_PATH folder)
      execute_process(COMMAND git -C ${folder} log -1 --format=%ct
        OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
      if(failed)
        set(sections ${dated})
      else()
        set(epoch ${commit})
      endif()
    endif()
  endif()
  if(NOT DEFINED epoch)
    if(NOT sections MATCHES ", ([0-9]+)-0*([0-9]+)-0*([0-9]+)")
      message(FATAL_ERROR "${changelog} has no section `## VERSION, YYYY-MM-DD`")
    endif()
    # Days since 1970 in the Gregorian calendar, with years that begin in March, so that leap days come last.
    set(day ${CMAKE_MATCH_3})
    math(EXPR month "(${CMAKE_MATCH_2} + 9) % 12")
    math(EXPR year "${CMAKE_MATCH_1} - ${month} / 10")
    math(EXPR leap_days "${year} / 4 - ${year} / 100 + ${year} / 400")
    math(EXPR epoch "86400 * (365 * ${year} + ${leap_days} + (306 * ${month} + 5) / 10 + ${day} - 719469)")
  endif()
  set(before $ENV{SOURCE_DATE_EPOCH})
  set(ENV{SOURCE_DATE_EPOCH} ${epoch})  # what string(TIMESTAMP) takes for now
  string(TIMESTAMP date "${format}" UTC)
  set(ENV{SOURCE_DATE_EPOCH} ${before})
  set(${out} "${date}" PARENT_SCOPE)
endfunction()
