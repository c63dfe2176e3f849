#include "ui/keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cctype>
#include <string>
#include <utility>

namespace bn::ui {
namespace {

constexpr std::pair<std::string_view, int> kNamed[] = {
    {"enter", GLFW_KEY_ENTER},    {"escape", GLFW_KEY_ESCAPE},      {"tab", GLFW_KEY_TAB},
    {"space", GLFW_KEY_SPACE},    {"left", GLFW_KEY_LEFT},          {"right", GLFW_KEY_RIGHT},
    {"up", GLFW_KEY_UP},          {"down", GLFW_KEY_DOWN},          {"backspace", GLFW_KEY_BACKSPACE},
    {"delete", GLFW_KEY_DELETE},  {"home", GLFW_KEY_HOME},          {"end", GLFW_KEY_END},
    {"pageup", GLFW_KEY_PAGE_UP}, {"pagedown", GLFW_KEY_PAGE_DOWN}, {"plus", GLFW_KEY_EQUAL},
    {"minus", GLFW_KEY_MINUS},    {"comma", GLFW_KEY_COMMA},        {"period", GLFW_KEY_PERIOD}};

int key_named(const std::string& name) {
  if (name.size() == 1 && std::isalnum(static_cast<unsigned char>(name[0]))) return std::toupper(name[0]);
  for (const auto& [word, key] : kNamed) {
    if (word == name) return key;
  }
  for (int i = 1; i <= 12; ++i) {
    if (name == "f" + std::to_string(i)) return GLFW_KEY_F1 + i - 1;
  }
  return 0;
}

}  // namespace

std::optional<Chord> parse_chord(std::string_view text) {
  Chord chord;
  std::string rest;
  for (const char c : text) rest += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (std::size_t plus; (plus = rest.find('+')) != std::string::npos; rest.erase(0, plus + 1)) {
    const std::string modifier = rest.substr(0, plus);
    if (modifier == "ctrl") {
      chord.ctrl = true;
    } else if (modifier == "shift") {
      chord.shift = true;
    } else if (modifier == "alt") {
      chord.alt = true;
    } else {
      return {};
    }
  }
  chord.key = key_named(rest);
  if (chord.key == 0) return {};
  return chord;
}

bool shortcut(std::string_view text) {
  const auto chord = parse_chord(text);
  const ImGuiIO& io = ImGui::GetIO();
  if (!chord || !ImGui::IsKeyPressed(chord->key, false)) return false;
  if (io.WantTextInput && !chord->ctrl && !chord->alt) return false;
  return io.KeyCtrl == chord->ctrl && io.KeyShift == chord->shift && io.KeyAlt == chord->alt;
}

void map_keys(ImGuiIO& io) {
  const std::pair<int, int> table[] = {{ImGuiKey_Tab, GLFW_KEY_TAB},
                                       {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                       {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                       {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                       {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                       {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
                                       {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
                                       {ImGuiKey_Home, GLFW_KEY_HOME},
                                       {ImGuiKey_End, GLFW_KEY_END},
                                       {ImGuiKey_Insert, GLFW_KEY_INSERT},
                                       {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                       {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                       {ImGuiKey_Space, GLFW_KEY_SPACE},
                                       {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                       {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                       {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
                                       {ImGuiKey_A, GLFW_KEY_A},
                                       {ImGuiKey_C, GLFW_KEY_C},
                                       {ImGuiKey_V, GLFW_KEY_V},
                                       {ImGuiKey_X, GLFW_KEY_X},
                                       {ImGuiKey_Y, GLFW_KEY_Y},
                                       {ImGuiKey_Z, GLFW_KEY_Z}};
  for (const auto& [ours, theirs] : table) io.KeyMap[ours] = theirs;
}

}  // namespace bn::ui
