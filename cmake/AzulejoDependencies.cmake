# Libraries that the engine stands on; none of them shows in an installed header.
find_package(PkgConfig REQUIRED)
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)
find_package(TIFF REQUIRED)
find_package(ZLIB REQUIRED)
find_package(Eigen3 REQUIRED)  # headers only, in sources only
find_package(glm REQUIRED)  # headers only; the public headers use its vectors
find_package(OpenEXR CONFIG REQUIRED)
find_package(pugixml REQUIRED)
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)
pkg_check_modules(WEBP REQUIRED IMPORTED_TARGET libwebp libwebpmux)
pkg_check_modules(LCMS REQUIRED IMPORTED_TARGET lcms2)
pkg_check_modules(HARFBUZZ REQUIRED IMPORTED_TARGET harfbuzz)

add_library(azulejo_libraries INTERFACE)
target_link_libraries(azulejo_libraries INTERFACE
  TBB::tbb fmt::fmt nlohmann_json::nlohmann_json PkgConfig::HWY
  PNG::PNG JPEG::JPEG TIFF::TIFF ZLIB::ZLIB OpenEXR::OpenEXR PkgConfig::WEBP PkgConfig::LCMS
  pugixml::pugixml PkgConfig::HARFBUZZ Eigen3::Eigen)

# The fonts that are copied into the library: what is drawn is the same on every machine, also where there is none.
set(AZULEJO_FONT_FOLDER /usr/share/fonts/truetype/dejavu CACHE PATH "Where DejaVuSans.ttf and DejaVuSans-Bold.ttf are")
foreach(font DejaVuSans.ttf DejaVuSans-Bold.ttf)
  if(NOT EXISTS ${AZULEJO_FONT_FOLDER}/${font})
    message(FATAL_ERROR "${AZULEJO_FONT_FOLDER}/${font} is missing: install fonts-dejavu-core, or set AZULEJO_FONT_FOLDER")
  endif()
endforeach()
set(azulejo_font_files ${AZULEJO_FONT_FOLDER}/DejaVuSans.ttf ${AZULEJO_FONT_FOLDER}/DejaVuSans-Bold.ttf)
set_source_files_properties(src/azulejo/charting/font_data.cpp PROPERTIES
  OBJECT_DEPENDS "${azulejo_font_files}"
  COMPILE_DEFINITIONS
    "AZULEJO_FONT_REGULAR=\"${AZULEJO_FONT_FOLDER}/DejaVuSans.ttf\";AZULEJO_FONT_BOLD=\"${AZULEJO_FONT_FOLDER}/DejaVuSans-Bold.ttf\"")
