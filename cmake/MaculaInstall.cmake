# `cmake --install` and find_package(macula): the library, its headers below include/macula, the
# program, the licence.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(modules shared kernels bvh scenes cl kernel frame stage method metric output report render
            selftest host)
foreach(module IN LISTS modules)
  if(NOT TARGET macula_${module})
    continue()
  endif()
  set_target_properties(macula_${module} PROPERTIES EXPORT_NAME ${module})
  target_include_directories(macula_${module} INTERFACE
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/macula>)
  target_compile_features(macula_${module} INTERFACE cxx_std_20)
  install(TARGETS macula_${module} EXPORT macula-targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endforeach()
# macula::macula is the whole library.
set_target_properties(macula_host PROPERTIES EXPORT_NAME macula)

install(DIRECTORY host bvh scenes DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/macula
        FILES_MATCHING PATTERN *.hpp PATTERN app EXCLUDE)

install(FILES host/macula.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/macula)
install(DIRECTORY kernels/shared kernels/lib DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/macula
        FILES_MATCHING PATTERN *.h)
install(TARGETS macula RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY scenes/files DESTINATION ${CMAKE_INSTALL_DATADIR}/macula/scenes OPTIONAL)

install(EXPORT macula-targets NAMESPACE macula::
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/macula)
configure_package_config_file(
  cmake/macula-config.cmake.in ${CMAKE_BINARY_DIR}/macula-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/macula)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/macula-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/macula-config.cmake
              ${CMAKE_BINARY_DIR}/macula-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/macula)
