// Types of what the page uses of lit-html 3.3.3 (BSD-3-Clause, see lit-html.LICENSE).

export interface TemplateResult {
  readonly strings: TemplateStringsArray;
  readonly values: unknown[];
}

/** A template of HTML; its expressions are escaped. */
export function html(strings: TemplateStringsArray, ...values: unknown[]): TemplateResult;
/** A template of SVG elements. */
export function svg(strings: TemplateStringsArray, ...values: unknown[]): TemplateResult;

export interface RenderOptions {
  /** `this` of event listeners. */
  host?: object;
  /** The child of the container before which to render. */
  renderBefore?: ChildNode | null;
}
/** Renders a value into a container; later calls only change what differs. */
export function render(value: unknown, container: HTMLElement | DocumentFragment, options?: RenderOptions): unknown;

/** Renders nothing, or takes an attribute away. */
export const nothing: unique symbol;
/** Leaves what is rendered as it is. */
export const noChange: unique symbol;

/** Renders a list by key, moving elements rather than filling them anew. */
export function repeat<Item>(
  items: Iterable<Item>,
  key: (item: Item, index: number) => unknown,
  template: (item: Item, index: number) => unknown,
): unknown;

/** Sets a property or attribute where the element's own value differs, as a person may have changed it. */
export function live(value: unknown): unknown;
