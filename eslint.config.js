// What is checked beside the types: rules that catch mistakes, none about layout.
import js from "@eslint/js";
import globals from "globals";

export default [
  { ignores: ["docs/site/**", ".venv/", "**/vendor/", "build/", "dist/", "**/_bundled/"] },
  js.configs.recommended,
  {
    rules: {
      "array-callback-return": "error",
      "eqeqeq": "error",
      "no-constructor-return": "error",
      "no-self-compare": "error",
      "no-template-curly-in-string": "error",
      "no-unmodified-loop-condition": "error",
      "no-unreachable-loop": "error",
      "no-use-before-define": ["error", { functions: false, variables: false, classes: false }],
      "no-var": "error",
      "prefer-const": "error",
    },
  },
  {
    files: ["web/**/*.js", "service/http/docs/*.js", "service/client/*.js"],
    languageOptions: { globals: globals.browser },
    rules: {
      // Nothing said or sent becomes markup or code.
      "no-eval": "error",
      "no-implied-eval": "error",
      "no-new-func": "error",
      "no-restricted-properties": ["error", { property: "innerHTML" }, { property: "outerHTML" }, { property: "insertAdjacentHTML" }],
      "max-lines": ["error", { max: 300, skipBlankLines: true }],
      "max-lines-per-function": ["error", { max: 60, skipBlankLines: true, skipComments: true }],
    },
  },
  { files: ["tests/web/**/*.mjs", "*.js"], languageOptions: { globals: { ...globals.nodeBuiltin, ...globals.browser } } },
  { files: ["service/http/docs/*.js"], languageOptions: { globals: { SwaggerUIBundle: "readonly" } } },
];
