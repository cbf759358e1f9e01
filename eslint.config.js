// Rules for the scripts of the page, beyond the types that tsc checks.

const PAGE = ["document", "window", "requestAnimationFrame", "setTimeout", "clearTimeout", "URL", "Blob", "Response",
  "DecompressionStream", "atob", "CSS", "Plotly", "console"];

export default [
  {
    files: ["src/suspension_ctrl/desk/explorer/**/*.js"],
    languageOptions: {
      ecmaVersion: 2022,
      sourceType: "module",
      globals: Object.fromEntries(PAGE.map((name) => [name, "readonly"])),
    },
    linterOptions: { reportUnusedDisableDirectives: "error" },
    rules: {
      "array-callback-return": "error", "consistent-return": "error", "default-case-last": "error",
      "eqeqeq": "error", "no-console": "error", "no-const-assign": "error", "no-dupe-keys": "error", "no-else-return": "error",
      "no-eval": "error", "no-fallthrough": "error", "no-implied-eval": "error", "no-param-reassign": "error",
      "no-self-compare": "error", "no-shadow": "error", "no-undef": "error", "no-unreachable": "error",
      "no-unused-vars": "error", "no-use-before-define": ["error", { functions: false, classes: false }],
      "no-useless-return": "error", "no-var": "error", "object-shorthand": "error", "prefer-const": "error",
      "max-lines": ["error", 260], "max-lines-per-function": ["error", 60],
    },
  },
];
