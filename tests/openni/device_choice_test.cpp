// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "device_choice.h"

#include "support/catch.h"
#include "virtual_rig.h"

namespace foothold::test {
namespace {

using Catch::Matchers::Contains;

OpenNIDeviceInfo camera(const std::string& uri, const std::string& name, int product_id) {
  OpenNIDeviceInfo info;
  info.uri = uri;
  info.vendor = "PrimeSense";
  info.name = name;
  info.usb_vendor_id = 0x1d27;
  info.usb_product_id = product_id;
  return info;
}

const OpenNIDeviceInfo kXtion = camera("1d27/0601@1/7", "PS1080", 0x0601);
const OpenNIDeviceInfo kXtionReplugged = camera("1d27/0601@1/9", "PS1080", 0x0601);
const OpenNIDeviceInfo kCarmine = camera("1d27/0609@2/3", "PS1080", 0x0609);

TEST_CASE("choose_device: takes the first, an index or a URI") {
  CHECK(capture::choose_device("", {kXtion, kCarmine}) == kXtion.uri);
  CHECK(capture::choose_device("1", {kXtion, kCarmine}) == kCarmine.uri);
  CHECK(capture::choose_device(kCarmine.uri, {kXtion, kCarmine}) == kCarmine.uri);
}

TEST_CASE("choose_device: explains what is missing") {
  const std::string wanted = GENERATE(as<std::string>{}, "2", "-1", "999999999999", "1d27/0601@1/8");
  CHECK_THAT(message_of<DeviceError>([&] {
               capture::choose_device(wanted, {kXtion, kCarmine});
             }),
             Contains("'" + wanted + "'") && Contains(kCarmine.uri));
  CHECK_THAT(message_of<DeviceError>([&] { capture::choose_device(wanted, {}); }), Contains("no camera found"));
}

TEST_CASE("find_again: a camera that comes back has its old or a new address") {
  CHECK(capture::find_again(kXtion, {kXtion}, {}, false) == kXtion.uri);
  CHECK(capture::find_again(kXtion, {kCarmine, kXtionReplugged}, {kXtionReplugged.uri}, false) == kXtionReplugged.uri);
  CHECK(capture::find_again(kXtion, {}, {}, true).empty());
}

TEST_CASE("find_again: leaves cameras alone that were there before") {
  CHECK(capture::find_again(kXtion, {kXtionReplugged, kCarmine}, {}, true).empty());
}

TEST_CASE("find_again: takes another model only for users who named no camera") {
  CHECK(capture::find_again(kXtion, {kCarmine}, {kCarmine.uri}, false).empty());
  CHECK(capture::find_again(kXtion, {kCarmine}, {kCarmine.uri}, true) == kCarmine.uri);
  CHECK(capture::find_again(kXtion, {kCarmine, kXtionReplugged}, {kXtionReplugged.uri, kCarmine.uri}, true) == kXtionReplugged.uri);
}

}  // namespace
}  // namespace foothold::test
