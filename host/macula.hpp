/// The whole library in one include: open a device, load a scene, render, read images and timings.
#pragma once

#include "host/cl/device.hpp"
#include "host/output/image.hpp"
#include "host/render/renderer.hpp"
#include "scenes/load.hpp"
